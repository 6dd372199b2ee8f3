# SPDX-License-Identifier: Apache-2.0
"""Time to a target by direct optimisation of a point mass with the lags of flight control and engine: an estimate of
the optimum, no bound. Needs the package casadi, whose IPOPT finds local optima.

States: airspeed and altitude / 1000, flight path, track, alpha, bank about the path, thrust between idle and maximum.
Commands: alpha, roll rate, thrust. Elevator and flap are those of steady flight, sideslip is none. After the target is
entered it is held for the dwell, by the nose, as the task asks."""
import math

import casadi as ca

from .bound import (ALTITUDE_TOLERANCE_FT, CONTROL_EARLIEST_S, HEADING_EARLIEST_S, PITCH_TOLERANCE_DEG,
                    SPEED_TOLERANCE_FPS, YAW_TOLERANCE_DEG)
from .forces import ALTITUDES_FT, GRAVITY_FT_S2, LEAST_LOAD_FACTOR, linear

# By `skein fdm fly` at 20,000 ft and 1100 ft/s: full aft stick brings 61 % of its load factor within a second, full
# roll stick 212 deg/s within 0.4 s, full throttle 98 % of its power within 0.6 s.
LOAD_FACTOR_LAG_S, ROLL_RATE_DEG_S, THRUST_LAG_S = 0.8, 200, 0.3
HIGHEST_ALPHA_DEG = 20  # where the limiter takes over
THRUST_IN_TRIM = 0.47
STEPS, HELD_STEPS = 50, 10
SCALE = 1000  # of ft/s and ft
MACHS = [0.4 + 0.1 * k for k in range(15)]
MORE_MACHS = [0.3 + 0.1 * k for k in range(25)]
LONGEST_S = 60


def table(name, axes, values):
    """A cubic spline through values, the first axis fastest."""
    return ca.interpolant(name, "bspline", axes, values)


class Plane:
    """Rates of the states, and what the task looks at, as functions of casadi."""

    def __init__(self, model, machs):
        alphas = [alpha for alpha in model.alphas_deg if alpha <= HIGHEST_ALPHA_DEG + 2]
        pairs = [[model.trimmed(alpha, row, mach) for alpha, row in zip(alphas, model.coefficients)] for mach in machs]
        cx, cz = (table(f"c{k}", [alphas, machs], [pair[k] for column in pairs for pair in column]) for k in (0, 1))
        rise = table("rise", [machs], [linear(mach, model.rise["mach"], model.rise["CD"]) for mach in machs])
        heights = list(ALTITUDES_FT[::5])
        idle, maximum = (table(level, [heights, machs], [model.thrust(level, height, mach) for mach in machs
                                                         for height in heights]) for level in ("idle", "maximum"))
        density = table("density", [heights], [model.air(height)[0] for height in heights])
        sound = table("sound", [heights], [model.air(height)[1] for height in heights])

        x, u = ca.MX.sym("x", 7), ca.MX.sym("u", 3)
        speed, height, path, track, alpha, bank, level = x[0] * SCALE, x[1] * SCALE, x[2], x[3], x[4], x[5], x[6]
        mach = speed / sound(height)
        q_s = density(height) * speed**2 / 2 * model.area
        mass = model.weight / GRAVITY_FT_S2

        def body_forces(at):
            where = ca.vertcat(at * 180 / math.pi, mach)
            return q_s * (cx(where) - rise(mach)), q_s * cz(where)

        forward, down = body_forces(alpha)
        where = ca.vertcat(height, mach)
        forward += idle(where) + level * (maximum(where) - idle(where))
        along = ca.cos(alpha) * forward + ca.sin(alpha) * down
        across = ca.sin(alpha) * forward - ca.cos(alpha) * down
        rates = ca.vertcat((along / mass - GRAVITY_FT_S2 * ca.sin(path)) / SCALE, speed * ca.sin(path) / SCALE,
                           (across * ca.cos(bank) - model.weight * ca.cos(path)) / (mass * speed),
                           across * ca.sin(bank) / (mass * speed * ca.cos(path)),
                           (u[0] - alpha) / LOAD_FACTOR_LAG_S, u[1], (u[2] - level) / THRUST_LAG_S)
        self.rates = ca.Function("rates", [x, u], [rates])
        self.asked_load_factor = ca.Function("asked", [x, u], [-body_forces(u[0])[1] / model.weight])
        # The nose, ahead along the track, to its right and up.
        ahead = ca.cos(alpha) * ca.cos(path) - ca.sin(alpha) * ca.cos(bank) * ca.sin(path)
        right = ca.sin(alpha) * ca.sin(bank)
        up = ca.cos(alpha) * ca.sin(path) + ca.sin(alpha) * ca.cos(bank) * ca.cos(path)
        self.nose = ca.Function("nose", [x], [track + ca.atan2(right, ahead), ca.asin(up)])

    def step(self):
        x, u, dt = ca.MX.sym("x", 7), ca.MX.sym("u", 3), ca.MX.sym("dt")
        k1 = self.rates(x, u)
        k2 = self.rates(x + dt / 2 * k1, u)
        k3 = self.rates(x + dt / 2 * k2, u)
        k4 = self.rates(x + dt * k3, u)
        return ca.Function("step", [x, u, dt], [x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)])


class Optimum:
    """The least time for one task, by start and target; `region` is a bound.Region to stay in."""

    def __init__(self, model, task, load_factor, dwell_s, region=None):
        plane = Plane(model, MORE_MACHS if region else MACHS)
        self.task = task
        self.slowest, self.fastest = (speed / SCALE for speed in (region.speeds_fps if region else (400, 1750)))
        self.lowest, self.highest = (feet / SCALE for feet in (region.altitudes_ft if region else (2500, 38000)))
        self.count = STEPS + HELD_STEPS
        x, u = ca.MX.sym("x", 7, self.count + 1), ca.MX.sym("u", 3, self.count)
        seconds, start, target = ca.MX.sym("T"), ca.MX.sym("start", 7), ca.MX.sym("target", 3)
        intervals = ca.horzcat(ca.repmat(seconds / STEPS, 1, STEPS), ca.repmat(dwell_s / HELD_STEPS, 1, HELD_STEPS))
        defects = x[:, 1:] - plane.step().map(self.count)(x[:, :-1], u, intervals)
        asked = plane.asked_load_factor.map(self.count)(x[:, :-1], u)
        yaw, pitch = plane.nose.map(HELD_STEPS + 1)(x[:, STEPS:])
        held = x[:, STEPS:]
        first = (held[1, :] - target[0], ALTITUDE_TOLERANCE_FT / SCALE) if task == "heading" else (
            pitch - target[0], math.radians(PITCH_TOLERANCE_DEG))
        errors = [first, (yaw - target[1], math.radians(YAW_TOLERANCE_DEG)),
                  (held[0, :] - target[2], SPEED_TOLERANCE_FPS / SCALE)]
        equalities = [ca.vec(defects), x[:, 0] - start]
        inside = [ca.vec(error) / tolerance for error, tolerance in errors]
        constraints = ca.vertcat(*equalities, ca.vec(asked), *inside)
        zeros, inner = 7 * (self.count + 1), 3 * (HELD_STEPS + 1)
        self.lower = [0] * zeros + [LEAST_LOAD_FACTOR] * self.count + [-1] * inner
        self.upper = [0] * zeros + [load_factor] * self.count + [1] * inner
        smooth = 1e-4 * ca.sumsqr(u[:, 1:] - u[:, :-1])  # else commands that change nothing are free
        options = {"print_time": 0, "ipopt": {"print_level": 0, "sb": "yes", "max_iter": 400, "max_cpu_time": 20.0,
                                              "tol": 1e-5, "acceptable_tol": 1e-3, "acceptable_iter": 8}}
        self.solver = ca.nlpsol("time", "ipopt", {"x": ca.veccat(x, u, seconds), "p": ca.vertcat(start, target),
                                                  "f": seconds + smooth, "g": constraints}, options)

    def seconds(self, start, target):
        """The best of two first guesses, a turn and one that dives; None where neither comes to an optimum."""
        found = [self._solve(start, target, bank, dive) for bank, dive in ((1.3, 0.0), (1.9, 2.0))]
        return min((seconds for seconds in found if seconds is not None), default=None)

    def _solve(self, start, target, bank, dive):
        altitude, speed = start[0] / SCALE, start[2] / SCALE
        yaw, end_speed = math.radians(math.remainder(target[1] - start[1], 360)), target[2] / SCALE
        first = target[0] / SCALE if self.task == "heading" else math.radians(target[0])
        guess_s = max(7, 8 * abs(yaw) + 67 * abs(end_speed - speed) + 3)
        end_path = 0 if self.task == "heading" else first
        end_altitude = first if self.task == "heading" else altitude + guess_s * speed / 2 * math.sin(first)
        thrust = 0.9 if end_speed > speed else 0.3
        states, commands = [], []
        for k in range(self.count + 1):
            part = min(k / STEPS, 1)
            pulling = min(1, 8 * part, 8 * (1 - part))
            states += [speed + part * (end_speed - speed),
                       altitude + part * (end_altitude - altitude) - dive * math.sin(math.pi * part), part * end_path,
                       part * yaw, 0.01 + 0.07 * pulling, math.copysign(bank * pulling, yaw), thrust]
        for _ in range(self.count):
            commands += [0.07, 0, thrust]
        alpha, roll = math.radians(HIGHEST_ALPHA_DEG), math.radians(ROLL_RATE_DEG_S)
        least = HEADING_EARLIEST_S if self.task == "heading" else 10 * CONTROL_EARLIEST_S
        lowest_state = [self.slowest, self.lowest, -1.3, -9, -0.05, -7, 0]
        highest_state = [self.fastest, self.highest, 1.3, 9, alpha, 7, 1]
        lowest = lowest_state * (self.count + 1) + [-0.05, -roll, 0] * self.count + [least]
        highest = highest_state * (self.count + 1) + [alpha, roll, 1] * self.count + [LONGEST_S]
        result = self.solver(x0=states + commands + [guess_s], lbx=lowest, ubx=highest, lbg=self.lower, ubg=self.upper,
                             p=[speed, altitude, 0, 0, math.radians(0.5), 0, THRUST_IN_TRIM, first, yaw, end_speed])
        return float(result["x"][-1]) if self.solver.stats()["success"] else None
