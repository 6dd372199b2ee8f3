# SPDX-License-Identifier: Apache-2.0
"""What a script writes of figures with --json: in the words of `skein bench`, and with what `skein info` says of the
program and the machine."""
import json
import math
import os
import platform
import statistics
import subprocess
import tempfile

from command_line import ROOT, fail


def said_as_json(command):
    """What a program writes with --json; one that fails ends the script."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "said.json")
        words = [str(word) for word in command]
        done = subprocess.run([*words, "--json", path], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode:
            fail(f"{' '.join(words)}: {done.stdout.strip() or done.returncode}")
        with open(path, encoding="utf-8") as file:
            return json.load(file)


def machine_of(program):
    """Commit, compiler, processor, SIMD target and the like: what a benchmark of the program has as `machine`."""
    return said_as_json([program, "info"])


def machine_of_scripts():
    """The same, as far as it goes, of figures that no program of Skein's has part in: the commit of the scripts' source
    tree, or "unknown", the processor, and the version of Python."""
    try:
        commit = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty", "--abbrev=10", "--match="],
                                capture_output=True, text=True).stdout.strip()
    except OSError:  # no git
        commit = ""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        names = [line.partition(":")[2].strip() for line in file if line.startswith("model name")]
    return {"commit": commit or "unknown", "cpu": names[0] if names else "unknown", "python": platform.python_version()}


def quantile(samples, share):
    """As src/bench/figure.cpp estimates what `share` of all values are below: definition 8 of Hyndman and Fan (The
    American Statistician 50, 1996), which few samples bias little."""
    ordered = sorted(samples)
    place = min(max(share * (len(ordered) + 1 / 3) + 1 / 3, 1), len(ordered)) - 1
    below = math.floor(place)
    above = min(below + 1, len(ordered) - 1)
    return ordered[below] + (place - below) * (ordered[above] - ordered[below])


def figure(samples, better):
    """Of samples in their order, of which `more` or `less` is better; the spread is that of the quartiles over the
    median, none if that is 0."""
    median = statistics.median(samples)
    spread = (quantile(samples, 0.75) - quantile(samples, 0.25)) / median if median else None
    return {"better": better, "median": median, "spread": spread, "samples": list(samples)}


def write_json(path, document):
    with open(path, "w", encoding="utf-8") as file:
        json.dump(document, file, indent=1)
        file.write("\n")
