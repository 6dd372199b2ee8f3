# SPDX-License-Identifier: Apache-2.0
"""Skein's flight control laws and actuators for the F-16, in plain Python.

The laws, their gains and their sources are those of docs/explanation/flight-control.md; envs/reference/flight_control.h
is their specification. A test replays flights that Skein recorded, and requires the same surfaces."""
import math
from dataclasses import dataclass


@dataclass
class Surfaces:
    """Degrees: elevator + nose down, aileron + rolls left, rudder + yaws left, leading-edge flap + down."""
    elevator: float = 0.0
    aileron: float = 0.0
    rudder: float = 0.0
    leading_edge_flap: float = 0.0


@dataclass
class Actuator:
    bandwidth: float  # 1/s
    rate_limit: float  # deg/s
    lowest: float  # deg
    highest: float

    def clip(self, angle):
        return min(max(angle, self.lowest), self.highest)

    def step(self, position, command, dt):
        """The position after a first-order response of dt seconds, within rate and position limits."""
        change = (self.clip(command) - position) * (1 - math.exp(-self.bandwidth * dt))
        largest = self.rate_limit * dt
        return self.clip(position + min(max(change, -largest), largest))


ACTUATORS = Surfaces(elevator=Actuator(20.2, 60, -25, 25), aileron=Actuator(20.2, 80, -21.5, 21.5),
                     rudder=Actuator(20.2, 120, -30, 30), leading_edge_flap=Actuator(7.25, 25, 0, 25))


def step_actuators(positions, commands, dt):
    return Surfaces(**{name: actuator.step(getattr(positions, name), getattr(commands, name), dt)
                       for name, actuator in vars(ACTUATORS).items()})


class Filter:
    """(b1 s + b0) / (s + a0) by Tustin's rule: y = n0 x + s, s' = n1 x - d1 y."""

    def __init__(self, b1, b0, a0, dt):
        k = 2 / dt
        self.n0, self.n1, self.d1 = (b1 * k + b0) / (k + a0), (-b1 * k + b0) / (k + a0), (-k + a0) / (k + a0)
        self.state = 0.0

    def settle(self, x):
        """Rests at the constant input x."""
        self.state = (self.n1 - self.d1 * self.n0) / (1 + self.d1) * x

    def step(self, x):
        y = self.n0 * x + self.state
        self.state = self.n1 * x - self.d1 * y
        return y


def ramp(x, x_low, y_low, x_high, y_high):
    return y_low + (y_high - y_low) * min(max((x - x_low) / (x_high - x_low), 0.0), 1.0)


def clip(value, lowest, highest):
    return min(max(value, lowest), highest)


def loop_gain(dynamic_pressure):
    """1 up to 300 psf, then falling: surfaces grow stronger with dynamic pressure."""
    return 300 / max(300, dynamic_pressure)


def interconnect(alpha):
    return clip(0.05 * alpha, -0.3, 1.5)


class ControlLaws:
    """From stick commands and sensors to surface commands, one control step of dt seconds at a time.

    Sensors are the State of task.py: alpha, p, q, r in radians, nz and ny in g, pressures in psf."""

    def __init__(self, dt):
        self.dt = dt
        self.alpha = Filter(0, 10, 10, dt)
        self.pitch_rate, self.pitch_rate_washout = Filter(0, 50, 50, dt), Filter(1, 0, 1, dt)
        self.load_factor, self.load_factor_command = Filter(0, 50, 50, dt), Filter(0, 8.3, 8.3, dt)
        self.pitch_lead = Filter(3, 12, 12, dt)
        self.roll_rate, self.roll_command = Filter(0, 50, 50, dt), Filter(0, 10, 10, dt)
        self.yaw_rate, self.yaw_washout = Filter(0, 50, 50, dt), Filter(1.5, 0, 1, dt)
        self.yaw_lead = Filter(3, 15, 15, dt)
        self.pedal, self.lateral_acceleration = Filter(0, 4, 4, dt), Filter(0, 20, 20, dt)
        self.flap = Filter(2, 7.25, 7.25, dt)
        self.pitch_integrator = self.roll_integrator = self.trim_aileron = self.trim_rudder = 0.0

    def settle(self, state, surfaces):
        """Rests where centred stick commands hold `surfaces` at these readings."""
        alpha = clip(math.degrees(state.alpha), -5, 30)
        p, q, r = math.degrees(state.p), math.degrees(state.q), math.degrees(state.r)
        gain = loop_gain(state.dynamic_pressure)
        self.alpha.settle(alpha)
        self.pitch_rate.settle(q)
        self.pitch_rate_washout.settle(q)
        self.load_factor.settle(state.nz - 1)
        feedback = max(0.0, 0.322 * (alpha - 15)) + state.nz - 1
        self.pitch_lead.settle(feedback)
        error = 1.5 * gain * (max(0.0, alpha - 20.4) + feedback)
        self.pitch_integrator = clip(surfaces.elevator - error - 0.5 * alpha, -25, 25)
        self.roll_rate.settle(p)
        self.trim_aileron = surfaces.aileron - 0.2 * gain * p
        self.yaw_rate.settle(r)
        self.yaw_washout.settle(r - p * math.radians(alpha))
        self.lateral_acceleration.settle(state.ny)
        self.trim_rudder = (surfaces.rudder - 4.8 * gain * state.ny -
                            interconnect(alpha) * (surfaces.aileron - self.trim_aileron))
        self.flap.settle(math.degrees(state.alpha))

    def step(self, pitch, roll, yaw, state):
        """Surface commands for stick commands in [-1, 1]: nose up, right wing down, nose right."""
        alpha = self.alpha.step(clip(math.degrees(state.alpha), -5, 30))
        gain = loop_gain(state.dynamic_pressure)
        roll_rate = self.roll_rate.step(math.degrees(state.p))
        elevator = self._elevator(pitch, max(abs(roll), abs(yaw)), alpha, gain, state)
        aileron = self._aileron(roll, roll_rate, alpha, gain)
        rudder = self._rudder(yaw, roll_rate, alpha, gain, aileron, state)
        flap = (1.38 * self.flap.step(math.degrees(state.alpha)) -
                9.05 * state.dynamic_pressure / state.static_pressure + 1.45)
        return Surfaces(elevator, aileron, rudder, ACTUATORS.leading_edge_flap.clip(flap))

    def _elevator(self, pitch, lateral, alpha, gain, state):
        """Commanded against felt load factor, inside the limits of alpha."""
        washed_rate = self.pitch_rate_washout.step(self.pitch_rate.step(math.degrees(state.q)))
        load_factor = self.load_factor.step(state.nz - 1)
        lowest = ramp(state.dynamic_pressure, 100, -1, 500, -4)
        wanted = 8 * pitch if pitch >= 0 else -lowest * pitch
        command = self.load_factor_command.step(clip(wanted, lowest * (1 - 0.5 * lateral), 8 - 3 * lateral))
        lead = 0.7 * ramp(state.dynamic_pressure, 110, 1, 319, 0.32) * washed_rate
        feedback = self.pitch_lead.step(max(0.0, 0.322 * (alpha - 15 + lead)) + 0.334 * washed_rate + load_factor)
        error = 1.5 * gain * (max(0.0, alpha - 20.4 + lead) - command + feedback)
        raw = self.pitch_integrator + error + 0.5 * alpha
        elevator = ACTUATORS.elevator.clip(raw)
        self.pitch_integrator = clip(self.pitch_integrator + self.dt * 5 * (error - (raw - elevator)), -25, 25)
        return elevator

    def _aileron(self, roll, roll_rate, alpha, gain):
        """Commanded against felt roll rate; the integrator trims while the wings should stay level."""
        command = self.roll_command.step(308 * ramp(alpha, 15, 1, 29, 0.25) * roll)
        error = 0.2 * gain * (roll_rate - command)
        raw = error + self.roll_integrator + self.trim_aileron
        aileron = ACTUATORS.aileron.clip(raw)
        fade = ramp(alpha, 10, 1, 20, 0)
        gate = fade if abs(roll) < 0.1 else 0.0
        rate = error * gate - 2 * (raw - aileron) - 0.5 * (1 - fade) * self.roll_integrator
        self.roll_integrator = clip(self.roll_integrator + self.dt * rate, -5, 5)
        return aileron

    def _rudder(self, yaw, roll_rate, alpha, gain, aileron, state):
        """From the pedals, yaw rate about the velocity vector, side force and the ailerons."""
        stability_rate = self.yaw_rate.step(math.degrees(state.r)) - roll_rate * math.radians(alpha)
        washed_rate = self.yaw_lead.step(self.yaw_washout.step(stability_rate))
        return ACTUATORS.rudder.clip(-self.pedal.step(30 * yaw) * ramp(alpha, 20, 1, 30, 0) * gain +
                                     0.75 * gain * washed_rate +
                                     4.8 * gain * self.lateral_acceleration.step(state.ny) +
                                     interconnect(alpha) * (aileron - self.trim_aileron) + self.trim_rudder)
