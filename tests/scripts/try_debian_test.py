#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts/try_debian leaves behind and lets through, in a chroot of a few programs, which a debootstrap of this
test makes."""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts/try_debian"
PROGRAMS = ["bash", "env", "sleep"]
WAIT_S = 300
DEBOOTSTRAP = """#!/usr/bin/env bash
mkdir -p "$3"/{proc,dev,sys,etc}
cp -r "$SKEIN_TEST_ROOT/." "$3"
"""
NOTHING = "#!/usr/bin/env bash\n"


def can_contain():
    return os.geteuid() == 0 and not subprocess.run(["unshare", "--mount-proc", "--pid", "--fork", "true"],
                                                    stderr=subprocess.DEVNULL).returncode


def write_program(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(0o755)


def copy_program(name, root):
    """With the libraries that it needs."""
    path = os.path.realpath(shutil.which(name))
    libraries = re.findall(r"(/\S+) \(0x", subprocess.run(["ldd", path], capture_output=True, text=True).stdout)
    for source, place in [(path, f"/usr/bin/{name}")] + [(library, library) for library in libraries]:
        (root / place[1:]).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, root / place[1:])


class TryDebian(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="skein-try-debian-"))
        self.addCleanup(shutil.rmtree, self.folder)
        root, tools, tree = (self.folder / name for name in ["root", "tools", "tree"])
        for name in PROGRAMS:
            copy_program(name, root)
        write_program(tools / "debootstrap", DEBOOTSTRAP)
        write_program(root / "usr/bin/dpkg", NOTHING)
        write_program(tree / "scripts/setup", NOTHING)
        self.script = shutil.copy(SCRIPT, tree / "scripts")
        subprocess.run(["git", "init", "--quiet", tree], check=True)
        self.environment = os.environ | {"PATH": f"{tools}:{os.environ['PATH']}", "SKEIN_TEST_ROOT": str(root),
                                         "SKEIN_CHROOTS": str(self.folder / "chroots")}

    def start(self, *command):
        # A shell cannot trap what was ignored before it began, as it is below nohup.
        defaults = ["env", "--default-signal=HUP,INT,TERM"]
        return subprocess.Popen([*defaults, self.script, "bookworm", *command], env=self.environment, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True)

    def run_there(self, *command):
        process = self.start(*command)
        return (*process.communicate(timeout=WAIT_S), process.returncode)

    def start_long(self):
        """What has a child that would outlive the test, and runs."""
        process = self.start("bash", "-c", "sleep 1000 & echo runs; wait")
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)  # the first of the two
        self.assertEqual(process.stdout.readline(), "runs\n")
        return process

    def expect_nothing_left(self):
        end = time.monotonic() + WAIT_S
        while (left := list(self.left())) and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual(left, [])

    def left(self):
        """Mounts that this process sees in the chroot, and processes in it."""
        for line in pathlib.Path("/proc/self/mountinfo").read_text().splitlines():
            if str(self.folder) in line:
                yield line
        for root in pathlib.Path("/proc").glob("[0-9]*/root"):
            try:
                if str(self.folder) in os.readlink(root):
                    yield str(root)
            except OSError:  # it has ended
                pass

    def test_hands_on_what_the_command_says_and_its_exit_code(self):
        output, _, code = self.run_there("bash", "-c", "echo here; exit 7")
        self.assertEqual((output, code), ("here\n", 7))
        self.expect_nothing_left()

    def test_leaves_a_folder_of_others_alone(self):
        chroot = self.folder / "chroots/bookworm"
        chroot.mkdir(parents=True)
        (chroot / "precious").touch()
        output, error, code = self.run_there("bash", "-c", "echo here")
        self.assertEqual((output, code), ("", 2))
        self.assertRegex(error, r"^scripts/try_debian: \S+/bookworm is not of this script: [^\n]+\n$")
        self.assertEqual([path.name for path in chroot.iterdir()], ["precious"])

    def test_begins_again_what_it_had_not_finished(self):
        chroot = self.folder / "chroots/bookworm"
        self.run_there("bash", "-c", ":")
        (chroot / "ready").unlink()
        (chroot / "half").touch()
        output, error, code = self.run_there("bash", "-c", "echo here")
        self.assertEqual((output, code), ("here\n", 0))
        self.assertRegex(error, r"^Making a chroot [^\n]+\n$")
        self.assertFalse((chroot / "half").exists())

    def test_keeps_a_chroot_that_is_ready(self):
        chroot = self.folder / "chroots/bookworm"
        self.run_there("bash", "-c", ":")
        (chroot / "begun").unlink()  # as of versions that did not mark it
        output, error, code = self.run_there("bash", "-c", "echo here")
        self.assertEqual((output, error, code), ("here\n", "", 0))

    def test_works_in_a_chroot_once_at_a_time(self):
        self.start_long()
        output, error, code = self.run_there("bash", "-c", "echo here")
        self.assertEqual((output, code), ("", 2))
        self.assertRegex(error, r"^scripts/try_debian: another one works in \S+/bookworm: [^\n]+\n$")

    def test_signals_end_it_with_all_that_it_started(self):
        for number in [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]:
            process = self.start_long()
            process.send_signal(number)
            _, error = process.communicate(timeout=WAIT_S)
            self.assertEqual(process.returncode, 128 + number)
            self.assertRegex(error, "^(Making a chroot [^\n]+\n)?$")
            self.assertEqual(list(self.left()), [])

    def test_what_it_started_ends_when_it_is_killed(self):
        process = self.start_long()
        process.kill()
        process.wait(timeout=WAIT_S)
        self.expect_nothing_left()


if __name__ == "__main__":
    if not can_contain():
        print("skipped: no right to make namespaces")
        sys.exit(0)
    unittest.main()
