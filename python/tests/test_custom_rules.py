# SPDX-License-Identifier: Apache-2.0
import threading
from functools import partial

import numpy as np
import pytest
from conftest import ROOT

import skein

SHORT = {
    "time_limit_steps": 200,
    "stagger_clocks": False,
    "action_repeat": 5,
    "observation_noise": 0,
    "hold_s": 0,
    "heading": {"dwell_s": 0, "earliest_success_step": 0},
}


def actions_of(envs, steps):
    return np.random.default_rng(0).uniform(-1, 1, (steps, *envs.action_space.shape)).astype(np.float32)


def test_a_function_that_returns_the_tasks_reward_changes_nothing():
    plain, ruled = (skein.make_vec("heading", 70, env=SHORT, reward=rule) for rule in (None, lambda at: at["reward"]))
    plain.reset(seed=1), ruled.reset(seed=1)
    for actions in actions_of(plain, 60):
        expected, shown = plain.step(actions), ruled.step(actions)
        for a, b in zip(expected[:4], shown[:4], strict=True):
            np.testing.assert_array_equal(a, b)
        if "final_info" in expected[4]:
            for key in ("termination", "episode_control_steps", "_episode_return"):
                np.testing.assert_array_equal(expected[4]["final_info"][key], shown[4]["final_info"][key])
            np.testing.assert_allclose(
                expected[4]["final_info"]["episode_return"], shown[4]["final_info"]["episode_return"], rtol=1e-4
            )


def test_columns_are_those_of_the_step_also_where_it_ended_an_episode():
    seen = []

    def reward(at):
        seen.append({name: at[name].copy() for name in at})
        return at["altitude_ft"]

    envs = skein.make_vec("heading", 50, env=SHORT, reward=reward)
    envs.reset(seed=2)
    ends = 0
    for actions in actions_of(envs, 60):
        targets = envs.targets()
        observation, rewards, terminated, truncated, info = envs.step(actions)
        at, over, state = seen[-1], terminated | truncated, envs.state()
        for name, column in state.items():
            np.testing.assert_array_equal(column[~over], at[name][~over], err_msg=name)
        np.testing.assert_array_equal(rewards, at["altitude_ft"])
        np.testing.assert_array_equal(targets[:, 1], at["target_yaw_rad"])
        np.testing.assert_array_equal(np.clip(actions[:, 2], -1, 1), at["action_roll"])
        if over.any():
            final = np.stack(info["final_obs"][over])
            altitude = final[:, envs.observation_names.index("altitude_scaled")]
            np.testing.assert_allclose(at["altitude_ft"][over] * 0.3048 / 5000, altitude, rtol=1e-5)
            np.testing.assert_allclose(at["error_0_scaled"][over], final[:, 0], atol=1e-5)
            np.testing.assert_allclose(np.sin(at["roll_rad"][over]), final[:, 4], atol=1e-5)
            np.testing.assert_allclose(np.sin(at["pitch_rad"][over]), final[:, 6], atol=1e-5)
            ends += over.sum()
    assert ends >= 50


def test_targets_are_those_in_force_when_the_step_began():
    seen = []
    env = {**SHORT, "time_limit_steps": 150, "mission": {"length_s": 20}}
    envs = skein.make_vec("heading", 300, env=env, reward=lambda at: seen.append(dict(at)) or at["reward"])
    envs.reset(seed=4)
    changed = 0
    for actions in actions_of(envs, 60):
        targets = envs.targets()
        *_, terminated, truncated, _ = envs.step(actions)
        names = [name for name in seen[-1] if name.startswith("target_")]
        assert names == ["target_altitude_ft", "target_yaw_rad", "target_true_airspeed_fps"]
        np.testing.assert_array_equal(targets, np.stack([seen[-1][name] for name in names], axis=1))
        changed += ((envs.targets() != targets).any(axis=1) & ~(terminated | truncated)).sum()
    assert changed > 0  # also within flights


def test_targets_and_errors_of_a_task_file_are_its_own_in_their_order():
    seen = []
    task = ROOT / "examples" / "tasks" / "level_turn.toml"  # of two errors: yaw, altitude
    noiseless = {"observation_noise": 0}
    envs = skein.make_vec(task, 4, env=noiseless, reward=lambda at: seen.append(dict(at)) or at["reward"])
    envs.reset(seed=1)
    observations, *_ = envs.step(np.zeros((4, 4), np.float32))
    assert [name for name in seen[0] if name.startswith("target_")] == ["target_yaw_rad", "target_altitude_ft"]
    errors = np.stack([seen[0][f"error_{i}_scaled"] for i in range(3)], axis=1)
    np.testing.assert_array_equal(errors[:, :2], observations[:, :2])
    np.testing.assert_array_equal(errors[:, 2], 0)
    assert "Those of a task file are in its order; of errors that it has not, zeros." in skein.FlightColumns.__doc__


def test_one_function_does_not_change_what_the_other_sees():
    def changed(at):
        at["altitude_ft"][:] = 0

    for rules in ({"reward": changed}, {"terminated": changed}):
        envs = skein.make_vec("heading", 4, **rules)
        envs.reset(seed=1)
        with pytest.raises(ValueError, match="read-only"):
            envs.step(np.zeros((4, 4)))


def test_columns_are_a_mapping():
    def reward(at):
        assert "altitude_ft" in at and "altitude_m" not in at and at.get("altitude_m") is None
        assert set(at) == set(at.keys()) and len(at) == len(list(at))
        with pytest.raises(KeyError) as raised:
            at["altitude_m"]
        assert isinstance(raised.value, skein.ConfigurationError)
        assert str(raised.value).startswith('there is no column "altitude_m"; known: ')
        return at["reward"]

    envs = skein.make_vec("heading", 2, reward=reward)
    envs.reset(seed=0)
    envs.step(np.zeros((2, 4)))


def test_the_airspeed_is_what_the_error_is_made_of():
    seen = {}
    envs = skein.make_vec("heading", 64, conditions={"windy": "60fps"}, env=SHORT, reward=lambda at: seen.update(at) or at["reward"])
    envs.reset(seed=0)
    for actions in actions_of(envs, 5):
        envs.step(actions)
    error = (seen["target_true_airspeed_fps"] - seen["true_airspeed_fps"]) * 0.3048 / 340
    np.testing.assert_allclose(error, seen["error_2_scaled"], atol=2e-5)
    turn = seen["target_yaw_rad"] - seen["yaw_rad"]
    np.testing.assert_allclose(np.sin(turn), np.sin(seen["error_1_scaled"]), atol=1e-4)


def test_a_function_ends_episodes():
    level = {**SHORT, "initial": {"training_bank_max_deg": 0}}
    envs = skein.make_vec("heading", 40, env=level, terminated=lambda at: np.abs(at["roll_rad"]) > 0.5)
    envs.reset(seed=3)
    lengths, ended = np.zeros(40, int), 0
    for actions in actions_of(envs, 40):
        actions[:, 2] = np.linspace(-1, 1, 40)
        observation, reward, terminated, truncated, info = envs.step(actions)
        lengths += 5
        own = info["termination"] == skein.CUSTOM_TERMINATION
        assert terminated[own].all()
        for i in np.flatnonzero(own):
            assert info["final_info"]["termination"][i] == "custom"
            assert info["final_info"]["episode_control_steps"][i] == lengths[i]
            sine, cosine = info["final_obs"][i][4:6]
            assert abs(np.arctan2(sine, cosine)) > 0.5
            assert abs(np.arctan2(*observation[i][4:6])) < 0.5  # the next episode's first
        lengths[terminated | truncated] = 0
        ended += own.sum()
    assert ended > 40


def test_one_aircraft_has_functions_too():
    env = skein.make("heading", env=SHORT, reward=lambda at: at["p_rad_s"], terminated=lambda at: at["roll_rad"] > 1)
    env.reset(seed=0)
    terminated, total = False, 0.0
    while not terminated:
        _, reward, terminated, _, info = env.step([0, 0, 1, 0])
        total += reward
    assert info["termination"] == "custom"
    np.testing.assert_allclose(info["episode_return"], total, rtol=1e-5)
    env.reset()
    assert not env.step([0, 0, 0, 0])[2]


@pytest.mark.parametrize(
    ("rules", "says"),
    [
        ({"reward": 3}, "function"),
        ({"reward": lambda at: 1.0}, r"shape \(8,\)"),
        ({"reward": lambda at: np.full(8, np.nan)}, "finite"),
        ({"reward": lambda at: np.full(8, 1e300)}, "finite in float32"),
        ({"reward": lambda at: [*range(7), [1]]}, r"shape \(8,\), but it returned list: "),
        ({"reward": lambda at: at["altitude_m"]}, "altitude_ft"),
        ({"terminated": lambda at: at["reward"]}, "truth values"),
        ({"terminated": lambda at: None}, "truth values"),
    ],
)
def test_what_a_function_must_not_return(rules, says):
    with pytest.raises(skein.Error, match=says):
        envs = skein.make_vec("heading", 8, **rules)
        envs.reset(seed=0)
        envs.step(np.zeros((8, 4)))


def test_an_action_that_is_not_finite_has_the_tasks_reward():
    envs = skein.make_vec("heading", 4, reward=lambda at: at["true_airspeed_fps"])
    plain = skein.make_vec("heading", 4)
    actions = np.zeros((4, 4), np.float32)
    actions[2, 1] = np.nan
    for each in (envs, plain):
        each.reset(seed=0)
    _, rewards, terminated, _, info = envs.step(actions)
    assert terminated.tolist() == [False, False, True, False]
    assert rewards[2] == plain.step(actions)[1][2] == info["final_info"]["episode_return"][2]
    assert (rewards[[0, 1, 3]] > 500).all()
    envs.step(np.zeros((4, 4)))


@pytest.mark.parametrize("begin", [lambda env, snapshot: env.reset(), lambda env, snapshot: env.restore(snapshot)])
def test_after_a_function_that_raised_an_episode_begins_anew(begin):
    fails = True

    def reward(at):
        if fails and (at["termination"] != 0).any():
            raise ZeroDivisionError("mine")
        return np.ones_like(at["reward"])

    env = skein.make("heading", reward=reward, env=SHORT)
    env.reset(seed=0)
    snapshot = env.snapshot()
    with pytest.raises(ZeroDivisionError, match="mine"):
        while True:
            env.step(np.zeros(4))
    fails = False
    with pytest.raises(skein.Error, match="failed in the step before.*reset all") as raised:
        env.step(np.zeros(4))
    assert "\n" not in str(raised.value)
    begin(env, snapshot)
    steps, over = 0, False
    while not over:
        *_, terminated, truncated, info = env.step(np.zeros(4))
        steps, over = steps + 1, terminated or truncated
    assert info["episode_return"] == steps


def test_after_an_interrupt_the_next_step_says_so():
    def reward(at):
        raise KeyboardInterrupt

    envs = skein.make_vec("heading", 2, reward=reward)
    envs.reset(seed=0)
    with pytest.raises(KeyboardInterrupt):
        envs.step(np.zeros((2, 4)))
    with pytest.raises(skein.Error, match="interrupted.*reset all"):
        envs.step(np.zeros((2, 4)))


PATIENCE_S = 0.2  # far longer than any of these calls takes


@pytest.mark.parametrize(
    "call",
    [
        lambda env, snapshot: env.step(env.action_space.sample()),
        lambda env, snapshot: env.reset(seed=2),
        lambda env, snapshot: env.restore(snapshot),
        lambda env, snapshot: env.snapshot(),
        lambda env, snapshot: env.state(),
        lambda env, snapshot: env.targets(),
    ],
    ids=["step", "reset", "restore", "snapshot", "state", "targets"],
)
@pytest.mark.parametrize("make", [partial(skein.make_vec, num_envs=3), skein.make], ids=["make_vec", "make"])
def test_a_thread_waits_for_the_whole_step_of_another(make, call):
    failures, waited = [], []

    def other_call():
        try:
            call(env, snapshot)
        except skein.Error as error:
            failures.append(error)

    other = threading.Thread(target=other_call)

    def reward(at):
        assert np.array_equal(env.state()["p_rad_s"], at["p_rad_s"])  # the step's own thread does not wait
        if not waited:
            other.start()
            other.join(PATIENCE_S)
            waited.append(other.is_alive())
        return at["reward"]

    env = make("heading", reward=reward)
    env.reset(seed=1)
    snapshot = env.snapshot()
    env.step(np.zeros(env.action_space.shape, np.float32))
    other.join()
    assert waited == [True] and not failures
