#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Scripts refuse what they do not know in one line, with exit code 2, before they do anything."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHELL = [".ci/nightly", "scripts/build", "scripts/count_microcontroller", "scripts/docs", "scripts/format",
         "scripts/fuzz", "scripts/package", "scripts/pictures", "scripts/setup", "scripts/test", "scripts/try_debian"]
NEED_THE_PACKAGE = ["compare_python", "python_reference"]
# What scripts read their arguments with: one that goes on finds no program to do harm with.
TOOLS = ["dirname", "grep", "sed", "tr"]
MORE = {"scripts/build": [["nosuch"], ["release", "--no-such-flag"]], "scripts/format": [["--check", "extra"]],
        "scripts/fuzz": [[".*"]],
        "scripts/test": [["--preset", "nosuch"], ["--preset", "fuzz"], ["--preset"], ["--all", "extra"]]}


def python_scripts():
    for path in sorted((ROOT / "scripts").iterdir()):
        if path.is_file() and not path.suffix and path.name not in NEED_THE_PACKAGE:
            if path.read_text().startswith("#!/usr/bin/env python3\n"):
                yield f"scripts/{path.name}"


class UnknownArguments(unittest.TestCase):
    def setUp(self):
        self.tools = pathlib.Path(tempfile.mkdtemp(prefix="skein-tools-"))
        self.addCleanup(shutil.rmtree, self.tools)
        for name in TOOLS:
            (self.tools / name).symlink_to(shutil.which(name))

    def expect_refusal(self, script, interpreter, arguments):
        done = subprocess.run([*interpreter, ROOT / script, *arguments], env=os.environ | {"PATH": str(self.tools)},
                              capture_output=True, text=True)
        said = f"{script} {' '.join(arguments)}: {done.stdout}{done.stderr}"
        self.assertEqual((done.returncode, done.stdout), (2, ""), said)
        self.assertRegex(done.stderr, rf"^{script}: [^\n]+\n$", said)

    def test_are_refused_by_shell_scripts(self):
        for script in SHELL:
            for arguments in [["--no-such-flag"], ["--help"], *MORE.get(script, [])]:
                self.expect_refusal(script, [shutil.which("bash")], arguments)

    def test_are_refused_by_python_scripts(self):
        scripts = list(python_scripts())
        self.assertIn("scripts/soak", scripts)
        for script in scripts:
            self.expect_refusal(script, [sys.executable, "-I", "-S"], ["--no-such-flag"])


if __name__ == "__main__":
    unittest.main()
