# SPDX-License-Identifier: Apache-2.0
"""Trims and open-loop step responses of JSBSim's F-16 airframe beside those of Skein's."""
import json
import math
import os
import subprocess
import tempfile

from jsbsim_flight.vehicle import AILERON_RAD, DT, ELEVATOR_RAD, RUDDER_RAD, SUBSTEPS, Vehicle, load_direct_model

CONDITIONS = [(5000, 500), (15000, 500), (15000, 700), (25000, 700), (35000, 850)]  # ft, ft/s
STEP_CONDITION = (15000, 500)
STEP_DEG = 1
TIMES = [0.5, 1.0, 2.0]  # s, after a step of STEP_DEG
# Surface: its index among the controls of a file for `skein fdm simulate`, and the quantities that it moves.
STEPS = {"elevator": (1, ["q", "alpha"]), "aileron": (2, ["p", "r"]), "rudder": (3, ["r", "beta"])}
UNITS = {"p": "deg/s", "q": "deg/s", "r": "deg/s", "alpha": "deg", "beta": "deg"}
CG_REFERENCE = 0.35  # of the chord: where JSBSim's aerodynamics act, as Skein's tables
WHY = """Why they differ:
- Ailerons and rudder: the tables that both models descend from give the effect of full deflection, 20 and 30 deg.
  JSBSim multiplies them with the deflection in radians, Skein with its share of full deflection: JSBSim's surfaces
  have 0.35 and 0.52 times the effect, and its responses about those shares of Skein's.
- Thrust: JSBSim's drag always rises with the Mach number, Skein's on demand (env.drag_rise). The difference at low
  Mach numbers was not traced.
- Alpha, elevator, pitch: JSBSim has other tables, with effects of the Mach number on stability and control; Skein has
  TP-1538's, with a leading-edge flap on its schedule, and is the less stable of the two at this centre of gravity."""


class Airframe(Vehicle):
    """JSBSim's F-16 without its control system, each surface where it was trimmed plus what set() adds."""

    def load(self):
        load_direct_model(self.fdm)

    def surfaces(self):
        raise NotImplementedError  # no observation is made of this one

    def trimmed(self):
        get = self.fdm.get_property_value
        return {"alpha": get("aero/alpha-deg"), "elevator": math.degrees(get("fcs/elevator-pos-rad")),
                "thrust": get("propulsion/engine/thrust-lbs")}

    def cg(self):
        """The centre of gravity as a fraction of the mean chord."""
        get = self.fdm.get_property_value
        aft_in = get("inertia/cg-x-in") - get("metrics/aero-rp-x-in")
        return CG_REFERENCE + aft_in / 12 / get("metrics/cbarw-ft")

    def responses(self, surface):
        """What p, q, r [deg/s], alpha and beta [deg] have changed by at TIMES after the step."""
        fdm, property_name, full = self.fdm, f"fcs/{surface}-cmd-norm", \
            {"elevator": ELEVATOR_RAD, "aileron": -AILERON_RAD, "rudder": RUDDER_RAD}[surface]
        fdm[property_name] = fdm[property_name] + math.radians(STEP_DEG) / full
        begin, changes = self.motion(), []
        for step in range(round(TIMES[-1] / DT * SUBSTEPS)):
            fdm.run()
            if any(step + 1 == round(t / DT * SUBSTEPS) for t in TIMES):
                changes.append({name: value - begin[name] for name, value in self.motion().items()})
        return changes

    def motion(self):
        get = self.fdm.get_property_value
        rates = {name: math.degrees(get(f"velocities/{name}-rad_sec")) for name in "pqr"}
        return {**rates, "alpha": get("aero/alpha-deg"), "beta": get("aero/beta-deg")}


class SkeinAirframe:
    """Skein's, by the program's `fdm trim` and `fdm simulate`."""

    def __init__(self, program, altitude_ft, airspeed_fps, cg):
        self.program = program
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "trim.json")
            self.run(["trim", "--altitude-ft", str(altitude_ft), "--speed-fps", str(airspeed_fps), "--xcg", str(cg),
                      "--atmosphere", "standard_1976", "--json", out])
            with open(out) as file:
                self.trim = json.load(file)

    def run(self, arguments):
        done = subprocess.run([self.program, "fdm", *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True)
        if done.returncode != 0:
            raise RuntimeError(f"skein fdm {arguments[0]} failed: {done.stdout.strip()}")

    def trimmed(self):
        thrust, elevator = self.trim["controls"][:2]
        return {"alpha": self.trim["alpha_deg"], "elevator": elevator, "thrust": thrust}

    def responses(self, surface):
        flight = {"initial_state": self.trim["state"], "trim_controls": self.trim["controls"],
                  "params": self.trim["params"], "t": [0.0, *TIMES],
                  "pulses": [{"control_index": STEPS[surface][0], "t_start": 0, "t_end": 1e3, "delta": STEP_DEG}]}
        with tempfile.TemporaryDirectory() as folder:
            given, flown = os.path.join(folder, "given.json"), os.path.join(folder, "flown.json")
            with open(given, "w") as file:
                json.dump({"trajectories": [flight]}, file)
            self.run(["simulate", "--in", given, "--out", flown, "--atmosphere", "standard_1976"])
            with open(flown) as file:
                states = json.load(file)["trajectories"][0]["states_dt0_02"]
        begin = self.motion(states[0])
        return [{name: value - begin[name] for name, value in self.motion(state).items()} for state in states[1:]]

    @staticmethod
    def motion(state):
        u, v, w = state[:3]
        rates = {name: math.degrees(value) for name, value in zip("pqr", state[3:6])}
        return {**rates, "alpha": math.degrees(math.atan2(w, u)),
                "beta": math.degrees(math.asin(v / math.sqrt(u * u + v * v + w * w)))}


def row(label, first, second, decimals):
    return f"  {label:<26}" + "".join(f"{a:>11.{decimals}f}{b:>9.{decimals}f}" for a, b in zip(first, second))


def head(label, columns):
    names = "".join(f"{name:>20}" for name in columns)
    return f"  {label:<26}{names}\n  {'':<26}" + f"{'JSBSim':>11}{'Skein':>9}" * len(columns)


def print_side_by_side(program):
    """Trims and step responses. Raises TrimError or RuntimeError where one of the two has none."""
    cg = Airframe(*STEP_CONDITION).cg()
    print(f"JSBSim's F-16 beside Skein's: centre of gravity at {cg:.3f} of the chord, as JSBSim's; U.S. Standard "
          "Atmosphere 1976\n" + head("trimmed level flight", ["alpha, deg", "elevator, deg", "thrust, lbf"]))
    for altitude, speed in CONDITIONS:
        peer = Airframe(altitude, speed).trimmed()
        ours = SkeinAirframe(program, altitude, speed, cg).trimmed()
        print(row(f"{altitude} ft, {speed} ft/s", peer.values(), ours.values(), 2))
    altitude, speed = STEP_CONDITION
    print(f"\nChange after a step of {STEP_DEG} deg, control systems off, from {altitude} ft and {speed} ft/s\n"
          + head("", [f"after {t} s" for t in TIMES]))
    for surface, (_, quantities) in STEPS.items():
        peer = Airframe(altitude, speed).responses(surface)
        ours = SkeinAirframe(program, altitude, speed, cg).responses(surface)
        for name in quantities:
            print(row(f"{surface}: {name}, {UNITS[name]}", [r[name] for r in peer], [r[name] for r in ours], 3))
    print("\n" + WHY)
