# SPDX-License-Identifier: Apache-2.0
"""How long a target of Control can be held in steady flight: wings level, the lift that of a straight path, the thrust
between idle and maximum without lag. The nose may be anywhere within the pitch tolerance, and the airspeed within its
own; below LOWEST_ALTITUDE_FT a flight is lost.

It is what flight without manoeuvres gives. Weaving within the tolerances costs drag, so that some dives can be held for
longer, if not calmly. A target of Heading is held likewise, level at its altitude."""
import math

from .bound import PITCH_TOLERANCE_DEG, SPEED_TOLERANCE_FPS
from .forces import GRAVITY_FT_S2, PointMass, linear

LOWEST_ALTITUDE_FT = 2500  # env.termination.min_altitude_ft
STEP_S = 0.25
MACH_STEP = 0.02  # of the trimmed coefficients, which change with the flap alone
# The nearest first; the last within the tolerance, as 5 deg are not.
PITCH_OFFSETS_DEG = [0] + [sign * 0.99 * PITCH_TOLERANCE_DEG * k / 5 for k in range(1, 6) for sign in (1, -1)]
# A pitch further from the target's is taken only if it brings the airspeed nearer by more than this within a second.
WORTH_FPS = 0.3
RECOVERY_S = 2  # in which the airspeed is to come back to its target's
# From where in its tolerance the airspeed begins, and at which altitude above the start's: Control asks for none.
SPEED_OFFSETS_FPS = [share * SPEED_TOLERANCE_FPS for share in (0, 0.99, -0.99)]
ALTITUDE_OFFSETS_FT = [0] + [sign * 2500 * k for k in range(1, 15) for sign in (1, -1)]
HIGHEST_ALTITUDE_FT = 55000


class SteadyFlight:
    def __init__(self, model: PointMass):
        self.model = model
        self._trimmed = {}

    def _coefficients(self, mach):
        """(Cx, Cz) of every alpha."""
        key = round(mach / MACH_STEP)
        if key not in self._trimmed:
            self._trimmed[key] = [self.model.trimmed(alpha, row, key * MACH_STEP)
                                  for alpha, row in zip(self.model.alphas_deg, self.model.coefficients)]
        return self._trimmed[key]

    def straight(self, speed, altitude_ft, pitch_deg=None):
        """Flight path, rad, and the least and the greatest force along it, over the weight; None if no alpha gives the
        lift. The nose is at `pitch_deg`; without it the path is level."""
        model = self.model
        density, sound_speed = model.air(altitude_ft)
        mach = speed / sound_speed
        q_s = density * speed**2 / 2 * model.area / model.weight
        before = None
        for alpha_deg, (cx, cz) in zip(model.alphas_deg, self._coefficients(mach)):
            path = 0 if pitch_deg is None else math.radians(pitch_deg - alpha_deg)
            here = (-q_s * cz - math.cos(path), alpha_deg, cx, cz, path)
            if before is not None and before[0] < 0 <= here[0]:
                share = before[0] / (before[0] - here[0])
                alpha_deg, cx, cz, path = (a + share * (b - a) for a, b in zip(before[1:], here[1:]))
                break
            before = here
        else:
            return None
        alpha = math.radians(alpha_deg)
        cx -= linear(mach, model.rise["mach"], model.rise["CD"])
        thrusts = [model.thrust(level, altitude_ft, mach) / model.weight for level in ("idle", "maximum")]
        return (path,
                *(math.cos(alpha) * (thrust + q_s * cx) + math.sin(alpha) * q_s * cz for thrust in thrusts))

    def next_state(self, speed, altitude_ft, target_pitch_deg, target_speed):
        """Airspeed and altitude a step later, with the nose where the airspeed stays nearest to its target; None where
        no such flight is steady. Level for a target without a pitch."""
        best = None
        level = target_pitch_deg is None
        for pitch in [None] if level else [target_pitch_deg + offset for offset in PITCH_OFFSETS_DEG]:
            flight = self.straight(speed, altitude_ft, pitch)
            if flight is None:
                continue
            path, least, greatest = flight
            wanted = math.sin(path) + (target_speed - speed) / (RECOVERY_S * GRAVITY_FT_S2)
            gain = (min(max(wanted, least), greatest) - math.sin(path)) * GRAVITY_FT_S2
            beside = abs(speed + gain - target_speed)
            if best is None or beside < best[0] - WORTH_FPS:
                best = (beside, gain, path)
        if best is None:
            return None
        _, gain, path = best
        speed += gain * STEP_S
        return speed, altitude_ft + speed * math.sin(path) * STEP_S

    def seconds_held(self, speed, altitude_ft, target_pitch_deg, target_speed, longest_s):
        """Seconds, `longest_s` at most, until the airspeed is out of its tolerance, the flight too low, or not steady."""
        for k in range(math.ceil(longest_s / STEP_S)):
            state = self.next_state(speed, altitude_ft, target_pitch_deg, target_speed)
            if state is None:
                return k * STEP_S
            speed, altitude_ft = state
            if abs(speed - target_speed) > SPEED_TOLERANCE_FPS or altitude_ft < LOWEST_ALTITUDE_FT:
                return k * STEP_S
        return longest_s

    def can_hold(self, altitudes_ft, target_pitch_deg, target_speed, dwell_s):
        """Whether it holds for `dwell_s` from any of the altitudes, at an airspeed anywhere in its tolerance."""
        return any(dwell_s == self.seconds_held(target_speed + offset, altitude, target_pitch_deg, target_speed, dwell_s)
                   for altitude in altitudes_ft for offset in SPEED_OFFSETS_FPS)

    def can_hold_target(self, task, start, target, dwell_s):
        """`start` and `target` as of point_mass.episodes."""
        if task == "heading":
            return self.can_hold([target[0]], None, target[2], dwell_s)
        altitudes = [altitude for altitude in (start[0] + offset for offset in ALTITUDE_OFFSETS_FT)
                     if LOWEST_ALTITUDE_FT < altitude < HIGHEST_ALTITUDE_FT]
        return self.can_hold(altitudes, target[0], target[2], dwell_s)
