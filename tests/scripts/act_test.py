#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts/act says of files that are no policies."""
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts/act"
METADATA = {"policy.format": "skein-policy-2", "policy.gru_size": "4", "policy.tanh_mean": "1",
            "policy.observation_size": "22"}


def file_of(header, data=b""):
    text = json.dumps(header).encode()
    return struct.pack("<Q", len(text)) + text + data


def error_of(content):
    """The line that the script ends with, of a file of this content."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "policy.skein")
        path.write_bytes(content)
        done = subprocess.run([sys.executable, "-I", "-S", SCRIPT, path], input="", capture_output=True, text=True)
    if done.returncode == 1 and done.stderr.count("\n") == 1:
        return done.stderr.partition("policy.skein: ")[2].strip()
    return f"exit code {done.returncode}: {done.stderr}"


NO_POLICY = "not a policy file, or a truncated one"


class File(unittest.TestCase):
    def test_of_another_kind_is_said_in_one_line(self):
        for header in [[], 1, {"__metadata__": 1}, {"__metadata__": METADATA, "weights": []},
                       {"__metadata__": METADATA, "weights": {"dtype": "F32", "data_offsets": ["0", "4"]}}]:
            self.assertEqual(error_of(file_of(header)), NO_POLICY, header)

    def test_that_is_truncated_is_said_in_one_line(self):
        whole = file_of({"__metadata__": METADATA, "weights": {"dtype": "F32", "shape": [1], "data_offsets": [0, 4]}},
                        struct.pack("<f", 1))
        for size in [0, 4, 8, 100, len(whole) - 1]:
            self.assertEqual(error_of(whole[:size]), NO_POLICY, size)
        self.assertNotEqual(error_of(whole), NO_POLICY)

    def test_without_what_it_must_have_is_said_in_one_line(self):
        self.assertEqual(error_of(file_of({})), "__metadata__ is missing")
        for key in ["policy.gru_size", "policy.tanh_mean", "policy.observation_size"]:
            metadata = {name: value for name, value in METADATA.items() if name != key}
            self.assertEqual(error_of(file_of({"__metadata__": metadata})), f"{key} is missing")


if __name__ == "__main__":
    unittest.main()
