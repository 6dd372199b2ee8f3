#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Builds of one preset take turns. Skipped without cmake, ninja or flock."""
import fcntl
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from script_module import SCRIPTS  # noqa: E402

PROJECT = """cmake_minimum_required(VERSION 3.22)
project(turns NONE)
add_custom_target(turn ALL COMMAND ${CMAKE_COMMAND} -E touch ${PROJECT_BINARY_DIR}/built)
"""
BUILD_PRESETS = '''"buildPresets": [
    { "name": "release", "configurePreset": "release" }
  ]'''


@unittest.skipUnless(all(map(shutil.which, ("cmake", "ninja", "flock"))), "no cmake, ninja or flock")
class Build(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = pathlib.Path(folder.name)
        (self.tree / "scripts").mkdir()
        shutil.copy(SCRIPTS / "build", self.tree / "scripts")
        (self.tree / "CMakeLists.txt").write_text(PROJECT)
        configure = {"name": "release", "generator": "Ninja", "binaryDir": "${sourceDir}/build/${presetName}"}
        (self.tree / "CMakePresets.json").write_text(
            f'{{"version": 3, "configurePresets": [{json.dumps(configure)}], {BUILD_PRESETS}}}')

    def test_waits_for_another(self):
        (self.tree / "build").mkdir()
        with open(self.tree / "build" / "release.lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            build = subprocess.Popen([self.tree / "scripts" / "build"], stderr=subprocess.PIPE, text=True)
            self.assertEqual(build.stderr.readline(),
                             "scripts/build: waiting for another build of the preset release\n")
            self.assertFalse((self.tree / "build" / "release").exists())
        self.assertEqual((build.communicate()[1], build.returncode), ("", 0))
        self.assertTrue((self.tree / "build" / "release" / "built").exists())


if __name__ == "__main__":
    unittest.main()
