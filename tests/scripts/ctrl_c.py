# SPDX-License-Identifier: Apache-2.0
"""Scripts that are interrupted while their program runs."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

from script_module import SCRIPTS, load_script

processes_of = load_script("reproduce").processes_of
WAIT_S = 300


class Interrupted:
    """A script that got a Ctrl-C while its program ran, which heeds none: how it ended, and what it left."""

    def __init__(self, name, *arguments):
        with tempfile.TemporaryDirectory() as place:
            program, temporary = pathlib.Path(place, "program"), pathlib.Path(place, "temporary")
            temporary.mkdir()
            program.write_text('#!/bin/sh\ntrap "" INT\ntouch "$TMPDIR/../started"\nwhile :; do sleep 0.1; done\n')
            program.chmod(0o755)
            # Python does not heed what was ignored before it began, as it is of a background job.
            words = ["env", "--default-signal=INT", sys.executable, SCRIPTS / name, f"--program={program}", *arguments]
            process = subprocess.Popen(words, env=os.environ | {"TMPDIR": str(temporary)}, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE, text=True, start_new_session=True)
            try:
                end = time.monotonic() + WAIT_S
                while not pathlib.Path(place, "started").exists() and process.poll() is None and time.monotonic() < end:
                    time.sleep(0.05)
                time.sleep(0.5)  # the script notes what it has started
                os.killpg(process.pid, signal.SIGINT)
                self.error = process.communicate(timeout=WAIT_S)[1]
            finally:
                process.kill()
            self.code = process.returncode
            self.left = [path.name for path in temporary.iterdir()]
            self.running = list(processes_of(place))
            for left in self.running:
                os.kill(left, signal.SIGKILL)
