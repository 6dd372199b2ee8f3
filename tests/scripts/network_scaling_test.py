#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts/network_scaling makes of measurements, without a network."""
import contextlib
import io
import json
import pathlib
import re
import sys
import tempfile
import unittest
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from script_module import load_script  # noqa: E402

scaling = load_script("network_scaling")
MODEL = {"share": 1.15, "latencies": 2.0, "latency_us": 30, "gradient_mb": 1.2, "rest_ms": 0.5}


def row_of(rate_gbit_s, delay_us, share, latencies, rest_s):
    """What a network would show in which the model holds."""
    row = {"ranks": 2, "rate_gbit_s": rate_gbit_s, "delay_us": delay_us, "round_trip_us": 40 + 2 * delay_us,
           "exchanges": 42, "sent_mb": 19.5, "gradient_s": 0.05}
    row["exchange_s"] = share * scaling.ideal_s(row) + latencies * scaling.latency_s(row) + rest_s
    row["idle_s"] = scaling.idle_s(row["exchange_s"], row["gradient_s"], scaling.MINIBATCHES)
    row["iteration_s"] = 0.3 + row["idle_s"]
    return row


class Fit(unittest.TestCase):
    def test_finds_what_a_byte_and_a_message_take(self):
        rows = [row_of(rate, delay, 1.2, 2.5, 0.02) for rate in (1, 5, 25) for delay in (50, 200, 1000)]
        fit, = scaling.fit(rows)
        self.assertAlmostEqual(fit["share_of_ideal"], 1.2, places=6)
        self.assertAlmostEqual(fit["latencies"], 2.5, places=6)
        self.assertAlmostEqual(fit["rest_s"], 0.02, places=6)
        for row in rows:
            self.assertAlmostEqual(scaling.predicted_s(row, fit), row["iteration_s"], places=6)

    def test_does_without_delays(self):
        fit, = scaling.fit([row_of(rate, 0, 1.2, 0, 0.02) for rate in (1, 5, 25)])
        self.assertAlmostEqual(fit["share_of_ideal"], 1.2, places=6)
        self.assertIsNone(fit["latencies"])

    def test_does_with_one_rate(self):
        fit, = scaling.fit([row_of(10, delay, 1, 2.5, 0.02) for delay in (50, 200, 1000)])
        self.assertEqual(fit["share_of_ideal"], 1)
        self.assertAlmostEqual(fit["latencies"], 2.5, places=6)
        self.assertAlmostEqual(fit["rest_s"], 0.02, places=6)


class LeftOut(unittest.TestCase):
    def test_a_row_is_predicted_by_the_others_alone(self):
        rows = [row_of(rate, 0, 1.2, 0, 0.02) for rate in (1, 2.5, 5, 25)]
        for row in rows:
            without = scaling.fit_without(row, rows)
            self.assertAlmostEqual(scaling.predicted_s(row, without), row["iteration_s"], places=6)
            self.assertAlmostEqual(scaling.error_percent(row, without), 0, places=6)
        # What is odd about a row does not reach its own prediction, but that of the fit that knows it.
        expected = rows[1]["iteration_s"]
        rows[1]["exchange_s"] += 1
        without = scaling.fit_without(rows[1], rows)
        self.assertAlmostEqual(scaling.predicted_s(rows[1], without), expected, places=6)
        fit, = scaling.fit(rows)
        self.assertGreater(scaling.predicted_s(rows[1], fit), expected + 0.1)

    def test_too_few_others_predict_nothing(self):
        rows = [row_of(rate, 0, 1.2, 0, 0.02) for rate in (1, 5)]
        self.assertIsNone(scaling.fit_without(rows[0], rows))

    def test_ends_are_of_what_was_varied(self):
        rows = [row_of(rate, 50, 1, 1, 0) for rate in (1, 5, 25)]
        self.assertEqual([scaling.is_at_an_end(row, rows) for row in rows], [True, False, True])


def printed_by(*arguments):
    out = io.StringIO()
    with mock.patch.object(sys, "argv", ["network_scaling", *arguments]), contextlib.redirect_stdout(out):
        scaling.main()
    return out.getvalue()


def printed_of(rows, *arguments):
    """By --model, of rows as --json writes them."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "network.json"
        path.write_text(json.dumps({"medians": rows, "fits": scaling.fit(rows)}))
        return printed_by("--model", str(path), *arguments)


class Document(unittest.TestCase):
    """What --json writes, and --model reads again."""

    def test_has_machine_samples_and_spread(self):
        points = [row_of(rate, 0, share, 0, 0.02) for share in (1.2, 1.3, 1.1) for rate in (1, 5, 25)]
        machine = {"commit": "0123456789", "cpu": "a processor"}
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(scaling.os, "geteuid", lambda: 0), \
                mock.patch.object(scaling.shutil, "which", lambda _: "/a/tool"), \
                mock.patch.object(scaling, "machine_of", lambda _: machine), \
                mock.patch.object(scaling, "measure", lambda *_: points):
            path = pathlib.Path(folder) / "network.json"
            printed = printed_by("--json", str(path), "--skein", sys.executable)
            self.assertEqual(printed_by("--model", str(path)), printed)
            document = json.loads(path.read_text())
        self.assertEqual((document["machine"], document["points"]), (machine, points))
        self.assertEqual([row["rate_gbit_s"] for row in document["medians"]], [1, 5, 25])
        for row, middle, least, most in zip(document["medians"], points[:3], points[6:], points[3:]):
            figures = row.pop("figures")
            self.assertEqual(row, middle)
            self.assertEqual(set(figures), set(row) - {"ranks", "rate_gbit_s", "delay_us"})
            exchange = figures["exchange_s"]
            self.assertEqual(set(exchange), {"better", "median", "spread", "samples"})
            self.assertEqual(exchange["samples"], [of["exchange_s"] for of in (middle, most, least)])
            self.assertGreater(exchange["spread"], 0)
            self.assertLess(exchange["spread"], most["exchange_s"] / least["exchange_s"] - 1)
            self.assertEqual(figures["sent_mb"]["spread"], 0)


class Printed(unittest.TestCase):
    """Of rows by hand, of which the law is known."""

    def test_errors_of_a_fit_that_does_not_know_the_row(self):
        rows = [row_of(rate, 0, 1.2, 0, 0.02) for rate in (1, 5, 25)] + [row_of(2.5, 0, 1.2, 0, 0.02)]
        rows[-1]["exchange_s"] *= 1.25  # of which the law of the others makes four fifths
        lines = printed_of(rows).splitlines()
        column = re.search("left out, %", lines[0]).end()
        self.assertEqual(lines[4][:column].split()[-1], "-20")
        self.assertRegex(lines[4], r"^ *2 +2\.5 ")

    def test_errors_of_a_fit_to_fewer_ranks(self):
        rows = [row_of(rate, 0, 1.2, 0, 0.02) for rate in (1, 5, 25)]
        rows += [{**row, "ranks": 4, "exchange_s": times * row["exchange_s"]} for row, times in zip(rows, (2, 4, 0.5))]
        said = printed_of(rows)
        self.assertIn("4 ranks, by the fit of 2 ranks: exchanging -75 to +100 % off\n", said)
        self.assertNotIn("2 ranks, by the fit", said)

    def test_a_rest_is_added_to_every_minibatch(self):
        rows = [row_of(rate, 0, 1.2, 0, 0.02) for rate in (1, 5, 25)]
        free = ("--latency-us=0", "--gradient-mb=0", "--presets", "some:0.1:20:0")
        for rest, plain, overlapping in ((), "100", "100"), (("--rest-ms=5",), "50*", "49*"):
            weak = [line for line in printed_of(rows, *free, *rest).splitlines() if " s weak " in line]
            self.assertEqual([line.split()[-1] for line in weak], 2 * [plain, overlapping])


class Model(unittest.TestCase):
    def test_a_network_that_takes_no_time_costs_nothing(self):
        free = {**MODEL, "latency_us": 0, "gradient_mb": 0, "rest_ms": 0}
        for overlaps in (False, True):
            self.assertEqual(scaling.seconds(64, 2.0, 1.4, 32, 10, free, overlaps), 2.0)

    def test_overlap_hides_no_more_than_the_gradients_and_no_more_than_the_exchange(self):
        for nodes in scaling.NODES:
            for gradient_s in (0.0, 0.01, 10.0):
                plain, hidden = (scaling.seconds(nodes, 12.0, gradient_s, 32, 10, MODEL, overlaps)
                                 for overlaps in (False, True))
                self.assertGreaterEqual(hidden, max(12.0, plain - gradient_s))
                if gradient_s > 0.01:
                    self.assertLess(hidden, plain)


if __name__ == "__main__":
    unittest.main()
