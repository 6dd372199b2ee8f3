#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""When scripts/reproduce does without ranks, and when it does not let a failure of theirs pass."""
import argparse
import pathlib
import sys
import unittest
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from script_module import load_script  # noqa: E402

reproduce = load_script("reproduce")


def search_by_two_ranks(error):
    """What a search learns of ranks where two of them end with `error`, and its numbers of ranks from then on."""
    search = reproduce.Search(argparse.Namespace(program="skein", seed=1), "", pathlib.Path("nowhere"))
    with mock.patch.object(search, "start"), mock.patch.object(reproduce.shutil, "rmtree"), \
            mock.patch.object(reproduce.shutil, "which", return_value="mpirun"), \
            mock.patch.object(search, "finish", side_effect=reproduce.Differs(error) if error else None):
        return search.find_ranks(), search.ranks


class Ranks(unittest.TestCase):
    def test_are_tried_where_two_end_well(self):
        self.assertEqual(search_by_two_ranks(""), ("", [1, 2, 4, 8]))

    def test_of_a_program_without_mpi_are_left_out(self):
        error = "exit code 1: skein: started as one of 2 processes, but trainings on several are not available (no module)"
        self.assertEqual(search_by_two_ranks(error), ("built without MPI", [1]))

    def test_that_fail_are_no_reason_to_do_without_them(self):
        with self.assertRaisesRegex(reproduce.Differs, "by two ranks: exit code 139"):
            search_by_two_ranks("exit code 139: ")


if __name__ == "__main__":
    unittest.main()
