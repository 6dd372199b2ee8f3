#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts/compare_python refuses, without the packages that it needs."""
import contextlib
import io
import pathlib
import subprocess
import sys
import unittest
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from script_module import SCRIPTS, load_script  # noqa: E402


def refusal(*arguments):
    """What it says of arguments that it does not take."""
    packages = {"numpy": mock.MagicMock(), "skein": mock.MagicMock(TASKS=("heading", "control", "tracking"))}
    said = io.StringIO()
    with mock.patch.dict(sys.modules, packages), mock.patch.object(sys, "argv", ["compare_python", *arguments]), \
            contextlib.redirect_stderr(said):
        try:
            load_script("compare_python").main()
        except SystemExit as end:
            return end.code, said.getvalue()
    return 0, said.getvalue()


class Arguments(unittest.TestCase):
    def test_that_measure_nothing_are_refused(self):
        for name in ("--aircraft", "--steps", "--pairs"):
            code, said = refusal(name, "0")
            self.assertEqual(code, 2)
            self.assertRegex(said, f"^scripts/compare_python: argument {name}: 0 is less than 1 [^\n]*\n$")

    def test_that_compare_different_tasks_are_refused(self):
        code, said = refusal("--peers", "--task", "control")
        self.assertEqual(code, 2)
        self.assertRegex(said, "^scripts/compare_python: argument --peers: the peers fly heading, not control [^\n]*\n$")

    def test_need_the_packages(self):
        command = [sys.executable, "-I", "-S", SCRIPTS / "compare_python", "--help"]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, "^scripts/compare_python: No module named 'numpy'; install the package: [^\n]*\n$")


if __name__ == "__main__":
    unittest.main()
