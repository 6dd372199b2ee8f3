# SPDX-License-Identifier: Apache-2.0
"""One flight: to its target, then holding it; and what is measured on the way."""
import math
import statistics
from dataclasses import dataclass

from jsbsim_flight.command_smoothness import action_figures
from jsbsim_flight.task import DT, TIME_LIMIT_STEPS, failure


@dataclass
class Rules:
    """What counts as reaching the target, and what follows: env.TASK.dwell_s and env.hold_s."""
    dwell_s: float = 0.0  # within all tolerances for so long without a break; 0: at first touch
    hold_s: float = 0.0  # for which the flight goes on after that, its target as it was

    @property
    def dwell_steps(self):
        return max(1, round(self.dwell_s / DT))

    @property
    def hold_steps(self):
        return round(self.hold_s / DT)


def root_mean_square(values):
    return math.sqrt(statistics.fmean(value * value for value in values))


def net_rolls_per_min(states):
    rolled = math.fsum(math.remainder(b.roll - a.roll, 2 * math.pi) for a, b in zip(states, states[1:]))
    return abs(rolled) / (2 * math.pi) / (len(states) - 1) / DT * 60


def hold_figures(states, within, asked_steps):
    """How a target was held, by the formulas of docs/reference/metrics.md: of the states after it was reached, and
    whether each was within tolerances. What of the time asked for was not flown was not within. What too few states
    do not say is left out."""
    def rms(name):
        return math.degrees(root_mean_square(getattr(state, name) for state in states))

    figures = {"within": sum(within) / asked_steps}
    if states:
        figures.update(rms_p_deg_s=rms("p"), rms_q_deg_s=rms("q"), rms_r_deg_s=rms("r"), rms_beta_deg=rms("beta"),
                       load_factor_deviation_g=statistics.pstdev(state.nz for state in states),
                       abs_bank_deg=math.degrees(statistics.fmean(abs(state.roll) for state in states)))
    if len(states) > 1:
        figures["net_rolls_per_min"] = net_rolls_per_min(states)
    return figures


def error_figures(task, states):
    """Root mean squares of the task's errors, in ft, deg and ft/s as the keys say."""
    return {"rms_error_" + column: unit * root_mean_square(errors)
            for (column, unit), errors in zip(task.ERRORS.items(), zip(*map(task.errors, states)))}


def step_time(step):
    return round(step * DT, 2) if step > 0 else None


def fly(vehicle, policy, task, rules, noise=lambda: 0.0):
    """Flies one episode and says how it ended; when it first touched the target, and when it had reached it (None:
    never); the time to the target, at which it entered the tolerances that it then held for the dwell; how smooth its
    actions were; and the figures of the hold, that of its actions among them. A flight that ends as non_finite was not
    within tolerances, and has no other of these figures. noise() is added to every observation."""
    policy.begin()
    state = vehicle.state()
    step = touched = reached = steps_within = 0
    actions, held, held_within, end = [], [], [], None
    while end is None:
        if step % policy.action_repeat == 0:
            throttle, *stick = policy.act([value + noise() for value in task.observe(state)])
        vehicle.step((throttle + 1) / 2, *stick)
        actions.append((throttle, *stick))
        state, step = vehicle.state(), step + 1
        end = failure(state)
        is_within = step >= task.EARLIEST_SUCCESS_STEP and task.is_within(state)
        steps_within = steps_within + 1 if is_within else 0
        if reached:
            held.append(state)
            held_within.append(is_within)
        touched = touched or step * is_within
        reached = reached or step * (end is None and steps_within >= rules.dwell_steps)
        if end is None and reached and step - reached >= rules.hold_steps:
            end = "target_reached"
        elif end is None and not reached and not is_within and step >= TIME_LIMIT_STEPS:
            end = "time_limit"
    if end == "non_finite":
        actions, held, held_within = [], [], []
    hold = None
    if reached and rules.hold_steps > 0:
        hold = {**hold_figures(held, held_within, rules.hold_steps), **error_figures(task, held),
                **action_figures(actions[reached:])}
    return {"end": end, "touched_s": step_time(touched), "reached_s": step_time(reached),
            "time_to_target_s": step_time(reached and reached - rules.dwell_steps + 1), "flown_s": step_time(step),
            "actions": action_figures(actions), "hold": hold}
