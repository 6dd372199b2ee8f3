#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Which packages scripts/setup takes for missing."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from script_module import SCRIPTS  # noqa: E402

# Every package is in the states that are its arguments, one for each architecture. The format is the third of dpkg's.
QUERY = """#!{bash}
for state in {states}; do printf "${{3//'${{db:Status-Status}}'/$state}}"; done
"""


def installs(*states):
    """Whether it would install packages that are in these states, without what it would do so with."""
    bash = shutil.which("bash")
    with tempfile.TemporaryDirectory() as folder:
        for name in ("dirname", "grep", "id"):
            pathlib.Path(folder, name).symlink_to(shutil.which(name))
        query = pathlib.Path(folder, "dpkg-query")
        query.write_text(QUERY.format(bash=bash, states=" ".join(states)))
        query.chmod(0o755)
        done = subprocess.run([bash, SCRIPTS / "setup"], env={"PATH": folder}, capture_output=True, text=True)
    return done.returncode != 0


# All packages are installed but the arguments.
QUERY_WITHOUT = """#!{bash}
[[ " {missing} " == *" $4 "* ]] || echo installed
"""


def without_root(*missing):
    """How it ends for a user who may install nothing, where these packages are not."""
    bash = shutil.which("bash")
    with tempfile.TemporaryDirectory() as folder:
        for name in ("dirname", "grep"):
            pathlib.Path(folder, name).symlink_to(shutil.which(name))
        for name, text in ("dpkg-query", QUERY_WITHOUT.format(bash=bash, missing=" ".join(missing))), \
                          ("id", f"#!{bash}\necho 1000\n"):
            program = pathlib.Path(folder, name)
            program.write_text(text)
            program.chmod(0o755)
        return subprocess.run([bash, SCRIPTS / "setup"], env={"PATH": folder}, capture_output=True, text=True)


class Setup(unittest.TestCase):
    def test_leaves_what_is_installed(self):
        self.assertFalse(installs("installed"))

    def test_leaves_what_is_installed_for_two_architectures(self):
        self.assertFalse(installs("installed", "installed"))
        self.assertFalse(installs("not-installed", "installed"))

    def test_installs_what_is_not(self):
        for states in [], ["not-installed"], ["config-files", "half-installed"]:
            self.assertTrue(installs(*states))

    def test_goes_on_without_what_is_optional_where_nothing_can_be_installed(self):
        done = without_root("libtorch-dev", "openmpi-bin")
        self.assertEqual(done.returncode, 0)
        self.assertIn("going on without libtorch-dev openmpi-bin", done.stderr)
        done = without_root("libtorch-dev", "libtbb-dev")
        self.assertEqual(done.returncode, 1)
        self.assertIn("apt-get install libtbb-dev libtorch-dev", done.stderr)


if __name__ == "__main__":
    unittest.main()
