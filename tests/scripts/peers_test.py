#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts/peers makes of measurements, by peers and a program that only pretend to measure."""
import contextlib
import io
import json
import math
import pathlib
import sys
import tempfile
import types
import unittest
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from script_module import SCRIPTS, load_script  # noqa: E402

peers = load_script("peers")

T95_OF_TWO, T95_OF_THREE = 12.7062047, 4.30265273  # Student's t of one and of two degrees of freedom
MACHINE = {"version": "1.2.3", "commit": "0123456789-dirty", "cpu": "a processor"}
FLOPS = 2e6  # of a sample
# A program that answers what the script asks; of either benchmark a run is twice as fast as the one before.
PROGRAM = """#!{python}
import json, pathlib, sys
command, path = sys.argv[1], pathlib.Path(sys.argv[-1])
if command == "train":
    print({keys!r})
elif command == "info":
    path.write_text(json.dumps({machine}))
else:
    count = pathlib.Path(__file__).with_name("runs of " + sys.argv[2])
    rate = 1000 * 2 ** (len(count.read_text()) if count.exists() else 0)
    with count.open("a") as file:
        file.write(".")
    learners = [dict(backend=backend, precision="fp32", samples_per_s=rate * share, gflops=rate * share * {flops} / 1e9)
                for backend, share in (("fused", 1), ("libtorch", 0.5))]
    path.write_text(json.dumps(dict(plant=dict(aircraft_steps_per_s=rate), learners=learners,
                                    environment=dict(aircraft_steps_per_s=rate / 2))))
"""
STEPS = """
from serving import serve
serve({"jsbsim_version": "9.9", "control_step_s": 0.02}, lambda: {"jsbsim_us": 1e6, "jsbgym_us": 2e6})
"""
UPDATE = """
import json, sys
from serving import serve
assert json.load(open(sys.argv[1]))["threads"] == 1
serve({"name": "JAX", "version": "7", "flops_per_sample": 2e6, "first_loss": 1, "last_loss": 1},
      lambda: {"samples_per_s": 100})
"""


def peer_with(flops=FLOPS, first=1.0, last=0.5, name="A peer"):
    """One that has introduced itself."""
    said = {"name": name, "version": "1", "flops_per_sample": flops, "first_loss": first, "last_loss": last}
    return types.SimpleNamespace(introduction=said)


def said_of(call, *arguments):
    """What a call prints, how it ends and what it says of that."""
    out, error = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
        try:
            call(*arguments)
        except SystemExit as end:
            return out.getvalue(), end.code, error.getvalue()
    return out.getvalue(), 0, error.getvalue()


class Interval(unittest.TestCase):
    def test_one_run_has_none(self):
        middle, low, high = peers.interval([3.0])
        self.assertAlmostEqual(middle, 3)
        self.assertEqual((low, high), (None, None))

    def test_is_students_of_the_logarithms(self):
        middle, low, high = peers.interval([2.0, 8.0])
        reach = T95_OF_TWO * (math.log(4) / math.sqrt(2)) / math.sqrt(2)
        for value, expected in ((middle, 4), (low, 4 * math.exp(-reach)), (high, 4 * math.exp(reach))):
            self.assertAlmostEqual(value / expected, 1)
        _, low, high = peers.interval([2.0, 4.0, 8.0])
        self.assertAlmostEqual(math.log(high / low), 2 * T95_OF_THREE * math.log(2) / math.sqrt(3))

    def test_is_the_same_whichever_is_over_which(self):
        ratios = [1.5, 1.7, 1.6, 2.0]
        middle, low, high = peers.interval(ratios)
        turned = peers.interval([1 / ratio for ratio in ratios])
        for value, other in zip(turned, (1 / middle, 1 / high, 1 / low)):
            self.assertAlmostEqual(value, other)


class SameWork(unittest.TestCase):
    def end_of(self, *others):
        skein = mock.Mock()
        skein.update.return_value = {("fused", "fp32"): {"gflops": 1e-9 * FLOPS * 50, "samples_per_s": 50}}
        return said_of(peers.require_same_work, others, skein)

    def test_passes_and_is_said(self):
        out, code, _ = self.end_of(peer_with(), peer_with(flops=FLOPS * 1.009, first=1.0009, name="Another"))
        self.assertEqual(code, 0)
        self.assertEqual(out, "same work: 2.000 M operations of matrix products a sample; "
                              "A peer: losses 1.000000 at the first and 0.500000 at the last minibatch; "
                              "Another: losses 1.000900 at the first and 0.500000 at the last minibatch\n")

    def test_other_products_are_refused(self):
        out, code, error = self.end_of(peer_with(), peer_with(flops=FLOPS * 1.02, name="Another"))
        self.assertEqual((out, code), ("", 1))
        self.assertRegex(error, "^[^\n]*: Another: 2040000.0 operations a sample, but Skein has 2000000\n$")

    def test_other_losses_are_refused(self):
        for loss, other in (("first_loss", peer_with(first=1.002)), ("last_loss", peer_with(last=0.502))):
            out, code, error = self.end_of(peer_with(), other)
            self.assertEqual((out, code), ("", 1))
            self.assertRegex(error, f"^[^\n]*: A peer: {loss} [0-9.]+, but A peer has [0-9.]+\n$")


class Table(unittest.TestCase):
    def row_with(self, runs):
        row = peers.Row("some work", "A peer 1", "samples")
        for run in range(runs):
            row.add(1000 + run, 2 * (1000 + run))
        return row.figures()

    def test_has_medians_ratio_and_interval(self):
        out, _, _ = said_of(peers.print_table, [self.row_with(3)], 3)
        head, line = out.splitlines()
        self.assertRegex(head, r"^ +a second +Skein +times  95 % \(3 runs\)$")
        self.assertRegex(line, r"^some work: A peer 1 +1,001 +2,002 +2\.00  2\.00 to 2\.00$")
        for word, number in (("a second", "1,001"), ("Skein", "2,002"), ("times", "2.00")):
            self.assertEqual(head.index(word) + len(word), line.index(number) + len(number), word)

    def test_of_one_run_has_no_interval(self):
        out, _, _ = said_of(peers.print_table, [self.row_with(1)], 1)
        self.assertRegex(out.splitlines()[1], r" 2\.00$")


class Measurement(unittest.TestCase):
    """The whole script, with files of peers that only pretend."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.program = self.folder / "skein"
        keys = "\n".join(f"{key} = 1" for key in peers.UPDATE_KEYS)
        self.program.write_text(PROGRAM.format(python=sys.executable, keys=keys, machine=MACHINE, flops=FLOPS))
        self.program.chmod(0o755)
        (self.folder / "serving.py").write_text((SCRIPTS / "peer_work" / "serving.py").read_text())
        (self.folder / "jsbsim_steps.py").write_text(STEPS)
        (self.folder / "jax_update.py").write_text(UPDATE)

    def document_of(self, *arguments):
        path = self.folder / "peers.json"
        words = ["peers", "--skein", str(self.program), "--json", str(path), "--threads", "1", *arguments]
        with mock.patch.object(sys, "argv", words), mock.patch.object(peers, "WORK", self.folder), \
                mock.patch.object(peers, "python_of", lambda peer, _: None if peer == "torch" else sys.executable):
            out, code, error = said_of(peers.main)
        self.assertEqual((code, error), (0, ""))
        return json.loads(path.read_text()), out

    def test_writes_machine_samples_and_spread(self):
        document, out = self.document_of("--what", "steps", "--runs", "3")
        self.assertEqual(document["machine"], MACHINE)
        self.assertEqual((document["threads"], document["runs"], document["not_here"]), (1, 3, []))
        plant, environment = document["rows"]
        self.assertEqual((plant["peer"], environment["peer"]), ("JSBSim 9.9", "jsbgym"))
        # The first run, of 1000, warms up.
        self.assertEqual(plant["figures"]["skein_per_s"]["samples"], [2000, 4000, 8000])
        self.assertEqual(plant["figures"]["peer_per_s"]["samples"], [50, 50, 50])
        self.assertEqual(environment["figures"]["skein_per_s"]["samples"], [1000, 2000, 4000])
        self.assertEqual(environment["figures"]["peer_per_s"]["samples"], [25, 25, 25])
        for row in document["rows"]:
            self.assertEqual(set(row), {"work", "peer", "unit", "peer_per_s", "skein_per_s", "times", "low", "high",
                                        "figures"})
            for name, figure in row["figures"].items():
                self.assertEqual(set(figure), {"better", "median", "spread", "samples"})
                self.assertEqual((figure["better"], figure["median"]), ("more", row[name]))
        self.assertEqual(plant["figures"]["peer_per_s"]["spread"], 0)
        self.assertGreater(plant["figures"]["skein_per_s"]["spread"], 0)
        self.assertAlmostEqual(plant["times"], 4000 / 50)
        self.assertLess(plant["low"], plant["times"])
        self.assertGreater(plant["high"], plant["times"])
        self.assertEqual(len(out.splitlines()), 3)

    def test_of_updates_is_by_the_same_work_beside_the_fused_kernels(self):
        document, out = self.document_of("--what", "update", "--runs", "1")
        jax, libtorch = document["rows"]
        self.assertEqual((jax["peer"], libtorch["peer"]), ("JAX 7", "LibTorch, as Skein's backend"))
        # Before the run that counts were one that held the work to the peers' and one that warmed up.
        self.assertEqual((jax["skein_per_s"], jax["peer_per_s"]), (4000, 100))
        self.assertEqual((libtorch["skein_per_s"], libtorch["peer_per_s"]), (4000, 2000))
        self.assertIsNone(jax["low"])
        self.assertEqual(len(document["not_here"]), 2)
        self.assertRegex(out, "^same work: 2.000 M [^\n]*; JAX: losses [^\n]*\n +a second [^\n]*\n")
        for line in document["not_here"]:
            self.assertIn(line + "\n", out)


if __name__ == "__main__":
    unittest.main()
