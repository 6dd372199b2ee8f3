#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts say of numbers and files that they do not take."""
import argparse
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))

from command_line import bounded, writable_file  # noqa: E402


class Bounded(unittest.TestCase):
    def test_takes_numbers_within_its_bounds(self):
        self.assertEqual([bounded(int, 1, 3)(text) for text in ("1", "3")], [1, 3])
        self.assertEqual(bounded(float, 0)("2.5"), 2.5)
        self.assertEqual(bounded(int, 1)("1" + "0" * 400), 10**400)

    def test_says_what_is_wrong(self):
        for number, text, says in [(bounded(int, 1), "0", "0 is less than 1"),
                                   (bounded(int, 1, 3), "4", "4 is not from 1 to 3"),
                                   (bounded(int, 1), "2.5", "2.5 is no whole number"),
                                   (bounded(float, 0), "-0.1", "-0.1 is less than 0"),
                                   (bounded(float, 0), "fast", "fast is no number"),
                                   (bounded(float, 0), "nan", "nan is no number"),
                                   (bounded(float, 0), "inf", "inf is no number")]:
            with self.assertRaises(argparse.ArgumentTypeError) as raised:
                number(text)
            self.assertEqual(str(raised.exception), says)


class WritableFile(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_is_left_as_it_is(self):
        new, old = self.folder / "new", self.folder / "old"
        old.write_text("kept")
        self.assertEqual([writable_file(str(path)) for path in (new, old)], [str(new), str(old)])
        self.assertFalse(new.exists())
        self.assertEqual(old.read_text(), "kept")

    def test_says_why_it_cannot_be_written(self):
        for path, says in [(self.folder, "Is a directory"),
                           (self.folder / "none" / "file", "No such file or directory")]:
            with self.assertRaises(argparse.ArgumentTypeError) as raised:
                writable_file(str(path))
            self.assertEqual(str(raised.exception), f"{path}: {says}")


if __name__ == "__main__":
    unittest.main()
