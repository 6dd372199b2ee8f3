# SPDX-License-Identifier: Apache-2.0
"""Scripts that are interrupted while their program runs."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

from script_module import SCRIPTS

WAIT_S = 300


def started_with(temporary):
    """The numbers of all processes whose folder of temporary files that is: what a script has started inherits it."""
    variable = f"TMPDIR={temporary}".encode()
    for file in pathlib.Path("/proc").glob("[0-9]*/environ"):
        try:
            if variable in file.read_bytes().split(b"\0"):
                yield int(file.parent.name)
        except OSError:  # it has ended, or is another user's
            pass


class Interrupted:
    """A script that got a signal while its program ran, which heeds none: how it ended, and what it left. A Ctrl-C
    (SIGINT) reaches all that it has started, too, others the script alone."""

    def __init__(self, name, *arguments, number=signal.SIGINT):
        with tempfile.TemporaryDirectory() as place:
            program, temporary = pathlib.Path(place, "program"), pathlib.Path(place, "temporary")
            temporary.mkdir()
            program.write_text('#!/bin/sh\ntrap "" INT TERM HUP\ntouch "$TMPDIR/../started"\nwhile :; do sleep 0.1; done\n')
            program.chmod(0o755)
            # Python does not heed what was ignored before it began, as it is of a background job.
            words = ["env", "--default-signal=INT,TERM,HUP", sys.executable, SCRIPTS / name, f"--program={program}",
                     *arguments]
            process = subprocess.Popen(words, env=os.environ | {"TMPDIR": str(temporary)}, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE, text=True, start_new_session=True)
            try:
                end = time.monotonic() + WAIT_S
                while not pathlib.Path(place, "started").exists() and process.poll() is None and time.monotonic() < end:
                    time.sleep(0.05)
                time.sleep(0.5)  # the script notes what it has started
                (os.killpg if number == signal.SIGINT else os.kill)(process.pid, number)
                self.error = process.communicate(timeout=WAIT_S)[1]
            finally:
                process.kill()
            self.code = process.returncode
            self.left = [path.name for path in temporary.iterdir()]
            time.sleep(0.5)  # the program's own sleep ends
            self.running = list(started_with(temporary))
            for left in self.running:
                os.kill(left, signal.SIGKILL)
