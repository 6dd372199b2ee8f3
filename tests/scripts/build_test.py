#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Two builds of one preset take turns. Skipped without cmake or ninja."""
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

# Building makes a folder that must not be there, and takes it away again.
PROJECT = """cmake_minimum_required(VERSION 3.22)
project(turns NONE)
add_custom_target(turn ALL COMMAND ${CMAKE_COMMAND} -E echo at work
                           COMMAND mkdir ${PROJECT_SOURCE_DIR}/turn
                           COMMAND sleep 1
                           COMMAND rmdir ${PROJECT_SOURCE_DIR}/turn)
"""
BUILD_PRESETS = '''"buildPresets": [
    { "name": "release", "configurePreset": "release" }
  ]'''


@unittest.skipUnless(shutil.which("cmake") and shutil.which("ninja"), "no cmake or ninja")
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

    def test_takes_turns(self):
        builds = [subprocess.Popen([self.tree / "scripts" / "build"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True) for _ in range(2)]
        said = [build.communicate()[1] for build in builds]
        self.assertEqual([build.returncode for build in builds], [0, 0], said)
        self.assertEqual(sorted(said), ["", "scripts/build: waiting for another build of the preset release\n"])


if __name__ == "__main__":
    unittest.main()
