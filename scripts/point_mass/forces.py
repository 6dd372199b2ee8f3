# SPDX-License-Identifier: Apache-2.0
"""Forces of the F-16 as a point mass: what Skein says of its aerodynamics and its air, and the tables of its engine.

The flap follows its schedule at once, the pitch rate is that of the flight path, sideslip is none. Units: ft, s, slug,
lbf, rad; angles in names that end in _deg."""
import bisect
import json
import math
import os
import subprocess
import tempfile

GRAVITY_FT_S2 = 32.17  # of the model: docs/reference/conventions.md
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
AIRCRAFT = os.path.join(ROOT, "data", "f16", "aircraft.json")
FLAPS_DEG = (0, 25)  # ends of the flap's range: coefficients are linear between them
ALTITUDES_FT = range(0, 60001, 500)
# What flight control keeps: docs/explanation/flight-control.md.
LOWEST_ALPHA_DEG, HIGHEST_ALPHA_DEG = -6, 30
LEAST_LOAD_FACTOR = -4
ASKED_SPEED_FPS = 1000


class ModelError(Exception):
    """The program does not say what it is asked, or the aircraft's file is not there."""


def linear(x, points, values):
    """The value at x between points, held beyond their ends."""
    if x <= points[0]:
        return values[0]
    if x >= points[-1]:
        return values[-1]
    k = bisect.bisect_right(points, x) - 1
    share = (x - points[k]) / (points[k + 1] - points[k])
    return values[k] + share * (values[k + 1] - values[k])


def ask(program, points, atmosphere="stevens_lewis"):
    """The points with what `skein fdm eval` adds to them."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [os.path.join(folder, name) for name in ("asked.json", "answered.json")]
        with open(paths[0], "w", encoding="utf-8") as file:
            json.dump({"points": points}, file)
        command = [program, "fdm", "eval", "--atmosphere", atmosphere, "--in", paths[0], "--out", paths[1]]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            raise ModelError(f"skein fdm eval failed: {done.stdout.strip()}")
        with open(paths[1], encoding="utf-8") as file:
            return json.load(file)["points"]


def point(alpha_deg=0.0, elevator_deg=0.0, flap_deg=0.0, pitch_rate=0.0, altitude_ft=20000):
    alpha = math.radians(alpha_deg)
    state = [ASKED_SPEED_FPS * math.cos(alpha), 0, ASKED_SPEED_FPS * math.sin(alpha), 0, pitch_rate, 0, 0, 0,
             -altitude_ft, 1, 0, 0, 0]
    return {"state": state, "controls": [0, elevator_deg, 0, 0, flap_deg]}


class PointMass:
    """The F-16, with drag rise and thrust growth as in the default presets."""

    def __init__(self, program: str, alpha_step_deg: float = 1, atmosphere: str = "stevens_lewis"):
        """`atmosphere` as of `skein fdm eval`."""
        try:
            with open(AIRCRAFT, encoding="utf-8") as file:
                document = json.load(file)
        except OSError as error:
            raise ModelError(f"{AIRCRAFT}: {error.strerror}") from error
        self.airframe, self.engine = document["airframe"], document["engine"]
        self.rise, self.gains = document["drag_rise"], document["flight_control"]
        self.weight = self.airframe["mass_slug"] * GRAVITY_FT_S2
        self.area = self.airframe["wing_area_ft2"]
        self.elevators_deg = document["aerodynamics"]["axes"]["elevator_deg"]
        steps = round((HIGHEST_ALPHA_DEG - LOWEST_ALPHA_DEG) / alpha_step_deg)
        self.alphas_deg = [LOWEST_ALPHA_DEG + alpha_step_deg * k for k in range(steps + 1)]
        self._ask_coefficients(program)
        self._ask_air(program, atmosphere)

    def _ask_coefficients(self, program):
        """[alpha][elevator] of (Cx, Cz, Cm), each with the flap at both ends, and what pitch rate adds to it."""
        keys = [(alpha, elevator, flap, rate) for alpha in self.alphas_deg for elevator in self.elevators_deg
                for flap in FLAPS_DEG for rate in (0, 1)]
        answers = iter(ask(program, [point(*key) for key in keys]))
        per_rate = self.airframe["chord_ft"] / (2 * ASKED_SPEED_FPS)
        self.coefficients = []
        for _ in self.alphas_deg:
            row = []
            for _ in self.elevators_deg:
                at_flaps = []
                for _ in FLAPS_DEG:
                    still, turning = next(answers)["coeffs"], next(answers)["coeffs"]
                    at_flaps.append([(still[k], (turning[k] - still[k]) / per_rate) for k in (0, 2, 4)])
                row.append(at_flaps)
            self.coefficients.append(row)

    def _ask_air(self, program, atmosphere):
        answers = ask(program, [point(altitude_ft=altitude) for altitude in ALTITUDES_FT], atmosphere)
        self.densities = [2 * answer["qbar_psf"] / ASKED_SPEED_FPS**2 for answer in answers]
        self.sound_speeds = [ASKED_SPEED_FPS / answer["mach"] for answer in answers]

    def air(self, altitude_ft):
        """Density and speed of sound."""
        return (linear(altitude_ft, ALTITUDES_FT, self.densities), linear(altitude_ft, ALTITUDES_FT, self.sound_speeds))

    def thrust(self, level, altitude_ft, mach):
        """Of `level` idle, military or maximum, lbf."""
        rows = [linear(mach, self.engine["mach"], row) for row in self.engine[level + "_lbf"]]
        growth = self.engine["growth"]
        return linear(altitude_ft, self.engine["altitude_ft"], rows) * linear(mach, growth["mach"], growth["factor"])

    def flap_deg(self, alpha_deg, mach):
        """The steady schedule; 0.7 M^2 is dynamic over static pressure."""
        gains = self.gains
        flap = gains["flap_alpha_gain"] * alpha_deg - gains["flap_pressure_gain_deg"] * 0.7 * mach**2
        return min(max(flap + gains["flap_bias_deg"], FLAPS_DEG[0]), FLAPS_DEG[1])

    def trimmed(self, alpha_deg, row, mach):
        """Cx and Cz without drag rise, by the elevator that balances the pitching moment; `row` is of that alpha."""
        share = self.flap_deg(alpha_deg, mach) / FLAPS_DEG[1]
        entries = [[up[k][0] + share * (down[k][0] - up[k][0]) for k in range(3)] for up, down in row]
        for before, after in zip(entries, entries[1:]):
            if before[2] >= 0 >= after[2]:
                part = before[2] / (before[2] - after[2]) if before[2] != after[2] else 0
                return [before[k] + part * (after[k] - before[k]) for k in (0, 1)]
        return entries[len(entries) // 2][:2]

    def forces(self, speed, altitude_ft):
        """Of every elevator node, a list over alpha of (nz, x, z, alpha): nz in g, aerodynamic forces along the body's
        x and z axes over the weight, alpha in rad."""
        density, sound_speed = self.air(altitude_ft)
        mach = speed / sound_speed
        rise = linear(mach, self.rise["mach"], self.rise["CD"])
        q_s = density * speed**2 / 2 * self.area / self.weight
        # Pitch rate over the load factor that turns the flight path, as c / (2 V).
        rate = GRAVITY_FT_S2 / speed * self.airframe["chord_ft"] / (2 * speed)
        curves = [[] for _ in self.elevators_deg]
        for alpha_deg, row in zip(self.alphas_deg, self.coefficients):
            share = self.flap_deg(alpha_deg, mach) / FLAPS_DEG[1]
            for curve, (up, down) in zip(curves, row):
                (cx, cx_q), (cz, cz_q) = ((up[k][0] + share * (down[k][0] - up[k][0]),
                                           up[k][1] + share * (down[k][1] - up[k][1])) for k in (0, 1))
                # The pitch rate is that of the path: by the load factor, which it raises, and up to 1 g of gravity.
                n = -q_s * cz / (1 + q_s * cz_q * rate) if cz < 0 else 0
                q = rate * (n + 1)
                cx, cz = cx - rise + cx_q * q, cz + cz_q * q
                curve.append((-q_s * cz, q_s * cx, q_s * cz, math.radians(alpha_deg)))
        return curves

    def manoeuvres(self, speed, altitude_ft, load_factor):
        """Extremes of (force along the path, force across it), both over the weight, that nz up to `load_factor` allows,
        at idle and at maximum thrust and with any elevator."""
        mach = speed / self.air(altitude_ft)[1]
        thrusts = [self.thrust(level, altitude_ft, mach) / self.weight for level in ("idle", "maximum")]
        found = []
        for curve in self.forces(speed, altitude_ft):
            for nz, x, z, alpha in limited(curve, load_factor):
                cosine, sine = math.cos(alpha), math.sin(alpha)
                for thrust in thrusts:
                    found.append((cosine * (thrust + x) + sine * z, abs(sine * (thrust + x) - cosine * z)))
        return found


def limited(curve, load_factor):
    """The curve's points within the limits, and those where it crosses them."""
    kept = [entry for entry in curve if LEAST_LOAD_FACTOR <= entry[0] <= load_factor]
    for before, after in zip(curve, curve[1:]):
        for limit in (LEAST_LOAD_FACTOR, load_factor):
            if (before[0] - limit) * (after[0] - limit) < 0:
                share = (limit - before[0]) / (after[0] - before[0])
                kept.append(tuple(a + share * (b - a) for a, b in zip(before, after)))
    return kept
