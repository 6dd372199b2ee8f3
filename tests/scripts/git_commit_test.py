#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The commit that cmake/Commit.cmake gives a build tells apart what it is made of. Skipped without git or cmake."""
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CLEAN, CHANGED = "[0-9a-f]{10}", "[0-9a-f]{10}-dirty-[0-9a-f]{10}"


@unittest.skipUnless(shutil.which("git") and shutil.which("cmake"), "no git or cmake")
class Commit(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.output = pathlib.Path(folder.name) / "commit.cpp"
        self.tree = pathlib.Path(folder.name) / "tree"
        (self.tree / "docs").mkdir(parents=True)
        self.git("init", "--quiet")
        self.write("source.cpp", "int a;\n")
        self.write("docs/page.txt", "A page.\n")
        self.git("add", ".")
        self.git("-c", "user.name=a", "-c", "user.email=a@b.c", "-c", "commit.gpgsign=false", "commit", "--quiet",
                 "--message=a")
        self.commit = self.said()
        self.assertRegex(self.commit, f"^{CLEAN}$")

    def git(self, *words):
        subprocess.run(["git", "-C", self.tree, *words], check=True)

    def write(self, name, content):
        (self.tree / name).write_text(content)

    def said(self):
        subprocess.run(["cmake", f"-DSOURCE={self.tree}", f"-DOUTPUT={self.output}", "-P",
                        ROOT / "cmake" / "Commit.cmake"], check=True)
        return re.search('kCommit = "([^"]*)"', self.output.read_text())[1]

    def said_with(self, name, content):
        self.write(name, content)
        said = self.said()
        self.assertTrue(said.startswith(f"{self.commit}-dirty"), said)
        return said

    def test_changes_are_told_apart_by_what_they_are(self):
        one, other = self.said_with("source.cpp", "int b;\n"), self.said_with("source.cpp", "int c; // [;\n")
        self.assertRegex(one, f"^{CHANGED}$")
        self.assertRegex(other, f"^{CHANGED}$")
        self.assertNotEqual(one, other)
        self.assertEqual(self.said_with("source.cpp", "int b;\n"), one)
        self.git("add", ".")
        self.assertEqual(self.said(), one)
        self.write("source.cpp", "int a;\n")
        self.git("add", ".")
        self.assertEqual(self.said(), self.commit)

    def test_pages_change_no_program(self):
        self.assertEqual(self.said_with("docs/page.txt", "Another.\n"), f"{self.commit}-dirty")


if __name__ == "__main__":
    unittest.main()
