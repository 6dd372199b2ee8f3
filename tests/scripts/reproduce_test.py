#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""When scripts/reproduce does without ranks, when it does not let a failure of theirs pass, and what it ends."""
import argparse
import contextlib
import io
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from ctrl_c import Interrupted  # noqa: E402
from script_module import SCRIPTS, load_script  # noqa: E402

reproduce = load_script("reproduce")


BUILT = ("build/src/skein", "build/train/mpi/libskein_mpi.so")
INSTALLED = (("usr/bin/skein", "usr/lib/x86_64-linux-gnu/skein/libskein_mpi.so"),
             ("opt/skein/bin/skein", "opt/skein/lib64/skein/libskein_mpi.so"))
UNAVAILABLE = "exit code 1: skein: started as one of 2 processes, but trainings on several are not available"


def search_by_two_ranks(error, files=BUILT):
    """What a search learns of ranks where two of them end with `error`, and its numbers of ranks from then on. The
    program is the first of `files`, which are all there is."""
    with tempfile.TemporaryDirectory() as folder:
        for file in files:
            path = pathlib.Path(folder, file)
            path.parent.mkdir(parents=True)
            path.touch()
        return ranks_of(pathlib.Path(folder, files[0]), error)


def ranks_of(program, error):
    search = reproduce.Search(argparse.Namespace(program=program, seed=1), "", pathlib.Path("nowhere"))
    with mock.patch.object(search, "start"), mock.patch.object(reproduce.shutil, "rmtree"), \
            mock.patch.object(reproduce.shutil, "which", return_value="mpirun"), \
            mock.patch.object(search, "finish", side_effect=reproduce.Differs(error) if error else None):
        return search.find_ranks(), search.ranks


class Ranks(unittest.TestCase):
    def test_are_tried_where_two_end_well(self):
        self.assertEqual(search_by_two_ranks(""), ("", [1, 2, 4, 8]))

    def test_are_tried_by_an_installed_program(self):
        for files in INSTALLED:
            self.assertEqual(search_by_two_ranks("", files), ("", [1, 2, 4, 8]))

    def test_of_a_program_without_the_mpi_module_are_left_out(self):
        for files in (BUILT, *INSTALLED):
            self.assertEqual(search_by_two_ranks(UNAVAILABLE, files[:1]), ("built without MPI", [1]))

    def test_whose_module_does_not_load_are_a_failure(self):
        for reason in ("undefined symbol: MPI_Init", "libskein_mpi.so is of another build than 0.2.0"):
            with self.assertRaisesRegex(reproduce.Differs, f"by two ranks: .*{reason}"):
                search_by_two_ranks(f"{UNAVAILABLE} ({reason})")

    def test_that_fail_are_no_reason_to_do_without_them(self):
        with self.assertRaisesRegex(reproduce.Differs, "by two ranks: exit code 139"):
            search_by_two_ranks("exit code 139: ")


def end_after_sigterm(ranks, *scripts):
    """What a search says of a training of `ranks` ranks that got SIGTERM. Each of the scripts is a process of it, the
    first one the one it started. None of them forks: until its exec, a child would count as one more process."""
    with tempfile.TemporaryDirectory() as folder:
        search = reproduce.Search(argparse.Namespace(program="skein", seed=1), "", pathlib.Path(folder))
        processes = [subprocess.Popen([sys.executable, "-c", script, str(search.run)], stdout=subprocess.PIPE,
                                      stderr=subprocess.PIPE, start_new_session=True) for script in scripts]
        search.process = processes[0]
        for process in processes:
            process.stdout.readline()  # its handler is there
        try:
            with mock.patch.object(reproduce, "MOST_WAIT_S", 0.2):
                search.process.terminate()
                return search.wait_for_end(ranks, signal.SIGTERM)
        finally:
            for process in processes:
                process.kill()
                process.communicate()


ENDS = "import signal; print(flush=True); signal.pause()"
STAYS = f"import signal; signal.signal(signal.SIGTERM, signal.SIG_IGN); {ENDS}"


class Interruption(unittest.TestCase):
    def test_by_a_signal_ends_a_training(self):
        self.assertEqual(end_after_sigterm(1, ENDS), "")
        self.assertEqual(end_after_sigterm(8, ENDS), "")

    def test_that_ends_all_ranks_but_mpirun_is_said(self):
        self.assertIn("mpirun hung", end_after_sigterm(8, STAYS))

    def test_that_does_not_end_a_training_is_found(self):
        for ranks, *scripts in (1, STAYS), (8, STAYS, STAYS):
            with self.assertRaisesRegex(reproduce.Differs, "SIGTERM|a rank is left"):
                end_after_sigterm(ranks, *scripts)

    def test_ends_the_training_under_way(self):
        trainings = []

        def interrupt(_, process):
            trainings.append(process)
            raise KeyboardInterrupt

        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder, "skein")
            program.write_text("#!/bin/sh\nexec sleep 1000\n")
            program.chmod(0o755)
            with mock.patch.object(reproduce.Search, "finish", interrupt), self.assertRaises(KeyboardInterrupt):
                reproduce.search(argparse.Namespace(program=program, seed=1), "", pathlib.Path(folder, "runs"))
        self.assertEqual([training.returncode for training in trainings], [-signal.SIGKILL])

    def test_leaves_nothing(self):
        for number in signal.SIGINT, signal.SIGTERM, signal.SIGHUP:
            ended = Interrupted("reproduce", "--load=1", number=number)
            self.assertEqual((ended.code, ended.error), (128 + number, "scripts/reproduce: interrupted\n"))
            self.assertEqual((ended.left, ended.running), ([], []))

    def test_keeps_runs_that_differ(self):
        def differ(arguments, target, folder):
            (folder / "run-1").mkdir(parents=True)
            raise KeyboardInterrupt

        said = io.StringIO()
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(reproduce, "search", differ), \
                mock.patch.object(tempfile, "tempdir", folder), contextlib.redirect_stderr(said), \
                mock.patch.object(sys, "argv", ["reproduce", f"--program={sys.executable}", "--load=0"]):
            with self.assertRaises(SystemExit) as ended:
                reproduce.main()
            self.assertEqual(ended.exception.code, 130)
            kept, = pathlib.Path(folder).iterdir()
            self.assertEqual(said.getvalue(), f"scripts/reproduce: interrupted; what differs is in {kept}\n")


class FirstRun(unittest.TestCase):
    def test_that_fails_is_kept_and_named(self):
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, SCRIPTS / "reproduce", "--load=0", f"--program={shutil.which('false')}"]
            done = subprocess.run(command, env=os.environ | {"TMPDIR": folder}, capture_output=True, text=True)
            kept, = pathlib.Path(folder).iterdir()
        self.assertEqual((done.returncode, done.stderr), (1, "scripts/reproduce: a first run failed: exit code 1: "
                                                             f"it said nothing; it is in {kept}\n"))


if __name__ == "__main__":
    unittest.main()
