# SPDX-License-Identifier: Apache-2.0
import copy
import pickle
import subprocess
import sys

import gymnasium
import numpy as np
import pytest
from conftest import ROOT
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode

import skein


# Episodes of a second: 50 control steps, ten policy steps.
SHORT = {
    "time_limit_steps": 50,
    "stagger_clocks": False,
    "action_repeat": 5,
    "hold_s": 0,
    "heading": {"dwell_s": 0, "earliest_success_step": 0},
}


def random_actions(envs, steps, seed=0):
    draw = np.random.default_rng(seed)
    return draw.uniform(-1, 1, (steps, *envs.action_space.shape)).astype(np.float32)


def rollout(envs, seed, steps=60):
    """Everything that an environment shows of a flight with random actions."""
    shown = [envs.reset(seed=seed)[0]]
    for actions in random_actions(envs, steps):
        observation, reward, terminated, truncated, info = envs.step(actions)
        shown += [observation, reward, terminated, truncated, info["termination"]]
    return shown


def assert_same(first, second):
    for a, b in zip(first, second, strict=True):
        np.testing.assert_array_equal(a, b)


@pytest.mark.parametrize("name", ["skein/Heading-v0", "skein/Control-v0", "skein/Tracking-v0"])
def test_gymnasiums_checker_passes(name):
    check_env(gymnasium.make(name).unwrapped, skip_render_check=True)


def test_gymnasium_makes_the_vector_environment():
    envs = gymnasium.make_vec("skein/Heading-v0", num_envs=3, vectorization_mode="vector_entry_point", preset="paper")
    assert isinstance(envs, skein.FlightVectorEnv)
    assert envs.config["env.action_repeat"] == skein.configure("heading", preset="paper")["env.action_repeat"]
    assert envs.metadata["autoreset_mode"] == AutoresetMode.SAME_STEP


def test_spaces_have_names_and_hold_what_is_flown():
    envs = skein.make_vec("heading", 64, **{"env.observation_noise": 0.05})
    assert len(envs.observation_names) == envs.single_observation_space.shape[0] == 22
    assert envs.action_names == ("throttle", "pitch", "roll", "yaw")
    assert envs.single_action_space.shape == (4,)
    observation, _ = envs.reset(seed=5)
    for actions in random_actions(envs, 300):
        assert envs.observation_space.contains(observation)
        observation, *_ = envs.step(actions)


@pytest.mark.parametrize("task", ["heading", "control"])
def test_a_seed_says_all(task):
    first, second = (rollout(skein.make_vec(task, 70), seed=3) for _ in range(2))
    assert_same(first, second)
    other = rollout(skein.make_vec(task, 70), seed=4)
    assert not np.array_equal(first[0], other[0])


def test_neither_threads_nor_other_environments_matter():
    whole = rollout(skein.make_vec("heading", 70, threads=1), seed=3)
    assert_same(whole, rollout(skein.make_vec("heading", 70, threads=3), seed=3))
    envs = skein.make_vec("heading", 40)
    observation, _ = envs.reset(seed=3)
    np.testing.assert_array_equal(observation, whole[0][:40])


def test_the_single_environment_is_the_first_of_many():
    settings = {"env.stagger_clocks": False}
    env, envs = skein.make("heading", **settings), skein.make_vec("heading", 1, **settings)
    np.testing.assert_array_equal(env.reset(seed=9)[0], envs.reset(seed=9)[0][0])
    for actions in random_actions(envs, 400):
        observation, reward, terminated, truncated, info = env.step(actions[0])
        observations, rewards, terminations, truncations, infos = envs.step(actions)
        assert (reward, terminated, truncated) == (rewards[0], terminations[0], truncations[0])
        if not terminated and not truncated:
            np.testing.assert_array_equal(observation, observations[0])
            continue
        np.testing.assert_array_equal(observation, infos["final_obs"][0])
        assert info["termination"] == infos["final_info"]["termination"][0]
        assert info["episode_return"] == infos["final_info"]["episode_return"][0]
        np.testing.assert_array_equal(env.reset()[0], observations[0])


def test_ends_are_reported_by_gymnasiums_rules():
    envs = skein.make_vec("heading", 50, env=SHORT)
    envs.reset(seed=1)
    ended = 0
    returns = np.zeros(50)
    for actions in random_actions(envs, 25):
        observation, reward, terminated, truncated, info = envs.step(actions)
        over = terminated | truncated
        returns += reward
        assert not (terminated & truncated).any()
        np.testing.assert_array_equal(over, info["termination"] != 0)
        if not over.any():
            assert set(info) == {"termination"}
            continue
        np.testing.assert_array_equal(info["_final_obs"], over)
        np.testing.assert_array_equal(info["_final_info"], over)
        for i in range(50):
            assert (info["final_obs"][i] is not None) == over[i]
            if not over[i]:
                continue
            reason = info["final_info"]["termination"][i]
            assert reason == skein.TERMINATION_NAMES[info["termination"][i]]
            assert not np.array_equal(info["final_obs"][i], observation[i])
            np.testing.assert_allclose(info["final_info"]["episode_return"][i], returns[i], rtol=1e-4)
            returns[i] = 0
            ended += 1
    assert ended >= 100


def test_a_time_limit_that_is_no_failure_truncates():
    for truncates in (False, True):
        envs = skein.make_vec("heading", 8, env=SHORT | {"truncate_at_time_limit": truncates})
        envs.reset(seed=0)
        for _ in range(9):
            *_, terminated, truncated, info = envs.step(np.zeros((8, 4), np.float32))
            assert not terminated.any() and not truncated.any()
        *_, terminated, truncated, info = envs.step(np.zeros((8, 4), np.float32))
        assert (truncated if truncates else terminated).all()
        assert (info["final_info"]["episode_control_steps"] == 50).all()


def test_a_mask_resets_a_part():
    envs = skein.make_vec("heading", 40)
    before, _ = envs.reset(seed=2)
    mask = np.zeros(40, bool)
    mask[[3, 39]] = True
    after, _ = envs.reset(options={"reset_mask": mask})
    np.testing.assert_array_equal((before != after).any(axis=1), mask)
    with pytest.raises(skein.Error, match="unknown option"):
        envs.reset(options={"mask": mask})


@pytest.mark.parametrize("make", [lambda: skein.make("heading"), lambda: skein.make_vec("heading", 2)])
def test_a_reset_that_is_refused_leaves_the_seed_of_what_is_flown(make):
    env = make()
    env.reset(seed=5)
    drawn = env.np_random.bit_generator.state
    refused = [{"mask": 1}, {"reset_mask": [True, True]}, {"reset_mask": [True]}]
    for options in refused:
        with pytest.raises(skein.Error):
            env.reset(seed=9, options=options)
    env.close()
    with pytest.raises(skein.Error, match="closed"):
        env.reset(seed=9)
    assert env.np_random_seed == 5 and env.np_random.bit_generator.state == drawn


def test_resets_without_a_seed_go_on_to_other_episodes():
    env = skein.make("heading")
    seen = [env.reset(seed=1)[0], env.reset()[0], env.reset()[0]]
    assert not np.array_equal(seen[0], seen[1]) and not np.array_equal(seen[1], seen[2])
    np.testing.assert_array_equal(env.reset(seed=1)[0], seen[0])
    np.testing.assert_array_equal(env.reset()[0], seen[1])


def test_a_snapshot_is_gone_on_from():
    envs = skein.make_vec("heading", 40)
    envs.reset(seed=6)
    snapshot = envs.snapshot()
    actions = random_actions(envs, 1)[0]
    observation, *_ = envs.step(actions)
    envs.restore(snapshot)
    np.testing.assert_array_equal(envs.step(actions)[0], observation)


def test_a_snapshot_of_one_aircraft_is_gone_on_from_in_the_middle_of_its_episode():
    env = skein.make("heading", env=SHORT)
    env.reset(seed=6)
    snapshot = env.snapshot()
    action = env.action_space.sample()
    expected, *_ = env.step(action)
    while not any(env.step(action)[2:4]):
        pass
    assert env.restore(snapshot).shape == expected.shape
    np.testing.assert_array_equal(env.step(action)[0], expected)
    other = skein.make("heading", env=SHORT)
    other.reset(seed=7)
    other.restore(snapshot)
    np.testing.assert_array_equal(other.step(action)[0], expected)


def test_a_snapshot_brings_its_seed_to_an_environment_that_has_not_begun():
    envs, fresh = (skein.make_vec("heading", 40, **{"env.observation_noise": 0.1}) for _ in range(2))
    envs.reset(seed=6)
    snapshot = envs.snapshot()
    actions = random_actions(envs, 400)
    np.testing.assert_array_equal(fresh.restore(snapshot), envs.restore(snapshot))
    for row in actions:  # over the ends of episodes, too
        expected, shown = envs.step(row), fresh.step(row)
        assert_same(expected[:4], shown[:4])
    assert_same(envs.reset(), fresh.reset())


@pytest.mark.parametrize("make", [lambda: skein.make("heading"), lambda: skein.make_vec("heading", 2)])
@pytest.mark.parametrize("seed", [6, 2**64 - 1])
def test_the_environments_seed_is_that_of_the_snapshot_that_it_goes_on_from(make, seed):
    env, other, fresh = make(), make(), make()
    first, _ = env.reset(seed=seed)
    other.reset(seed=7)
    for goes_on in (other, fresh):
        goes_on.restore(env.snapshot())
        assert goes_on.np_random_seed == env.np_random_seed == seed
        assert goes_on.np_random.bit_generator.state == env.np_random.bit_generator.state
        with pytest.raises(skein.Error, match="no snapshot"):
            goes_on.restore(np.zeros(3, np.uint32))
        assert goes_on.np_random_seed == seed
        np.testing.assert_array_equal(goes_on.reset(seed=goes_on.np_random_seed)[0], first)


def test_a_snapshot_of_something_else_is_refused_and_changes_nothing():
    envs, same = (skein.make_vec("heading", 40) for _ in range(2))
    envs.reset(seed=6), same.reset(seed=6)
    others = [
        (skein.make_vec("heading", 40, **{"env.observation_noise": 0.1}), "another configuration"),
        (skein.make_vec("heading", 40, evaluation=True), "another configuration"),
        (skein.make_vec("control", 40), "another configuration"),
        (skein.make_vec("heading", 41), "does not fit 40 aircraft"),
    ]
    for other, says in others:
        other.reset(seed=7)
        with pytest.raises(skein.Error, match=says) as raised:
            envs.restore(other.snapshot())
        assert "\n" not in str(raised.value)
    with pytest.raises(skein.Error, match="no snapshot"):
        envs.restore(np.zeros(3, np.uint32))
    actions = random_actions(envs, 1)[0]
    assert_same(envs.step(actions)[:4], same.step(actions)[:4])
    envs.close()
    with pytest.raises(skein.Error, match="closed"):
        envs.restore(same.snapshot())


def test_settings_of_the_training_alone_do_not_matter_to_a_snapshot():
    envs, other = skein.make_vec("heading", 4), skein.make_vec("heading", 4, **{"ppo.learning_rate": 1e-5})
    envs.reset(seed=0)
    other.restore(envs.snapshot())


def test_one_aircraft_staggers_no_clock_that_only_its_preset_staggers(tmp_path):
    says, is_silent = tmp_path / "says.toml", tmp_path / "silent.toml"
    says.write_text("env.stagger_clocks = true\n")
    is_silent.write_text("env.hold_s = 1 # and not stagger_clocks\n")
    task = ROOT / "examples" / "tasks" / "level_turn.toml"
    config = skein.configure("heading")
    assert config["env.stagger_clocks"] and skein.configure(task)["env.stagger_clocks"]
    staggers = {
        False: [{"task": "heading"}, {"task": "heading", "preset": "easy"}, {"task": str(task)}, {"task": task},
                {"task": "heading", "file": is_silent}, {"task": config, "env": {"stagger_clocks": False}}],
        True: [{"task": config}, {"task": "heading", "file": says}, {"task": "heading", "env.stagger_clocks": True},
               {"task": "heading", "env": {"stagger_clocks": True}}],
    }
    for expected, cases in staggers.items():
        for case in cases:
            assert skein.make(**case).config["env.stagger_clocks"] == expected, case


def make_vec(name, **settings):
    return gymnasium.make_vec(name, vectorization_mode="vector_entry_point", **settings)


@pytest.mark.parametrize("make", [gymnasium.make, make_vec])
@pytest.mark.filterwarnings("ignore:.*render_mode")
def test_nothing_is_drawn(make):
    make("skein/Heading-v0", render_mode=None).close()
    says = "render_mode must be None, not 'rgb_array'.*skein.record"
    with pytest.raises(skein.ConfigurationError, match=says) as raised:
        make("skein/Heading-v0", render_mode="rgb_array")
    assert isinstance(raised.value, TypeError)  # on which make_vec_env of Stable-Baselines3 asks for none
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize("make", [lambda: skein.make("heading"), lambda: skein.make_vec("heading", 2)])
@pytest.mark.parametrize("copied", [pickle.dumps, copy.copy, copy.deepcopy])
def test_environments_are_not_copied(make, copied):
    with pytest.raises(TypeError, match="neither pickled nor copied"):
        copied(make())


def test_lengths_of_first_episodes_are_what_was_flown():
    envs = skein.make_vec("heading", 64, env={**SHORT, "stagger_clocks": True, "time_limit_steps": 100})
    assert envs.config["env.stagger_clocks"]
    envs.reset(seed=2)
    steps, first_ends = np.zeros(64, int), np.zeros(64, bool)
    for actions in random_actions(envs, 25):
        _, _, terminated, truncated, info = envs.step(actions)
        steps += 5
        ended = (terminated | truncated) & ~first_ends
        if ended.any():
            flown = info["final_info"]["episode_control_steps"][ended]
            assert ((steps[ended] - 5 < flown) & (flown <= steps[ended])).all()
        first_ends |= ended
    assert first_ends.all() and len(set(steps)) == 1


@pytest.mark.parametrize("flight_control", ["full", "direct"])
@pytest.mark.parametrize("aircraft", ["f16", "cessna172"])
def test_observations_without_noise_lie_in_their_space(aircraft, flight_control):
    noiseless = {"env.observation_noise": 0, "env.training_noise_max": 0, "env.flight_control": flight_control}
    preset = "default" if aircraft == "f16" else aircraft
    envs = skein.make_vec("heading", 64, preset=preset, aircraft=aircraft, **noiseless)
    observation, _ = envs.reset(seed=3)
    lowest = observation
    for actions in random_actions(envs, 200):
        assert envs.observation_space.contains(observation)
        lowest = np.minimum(lowest, observation)
        observation, *_ = envs.step(np.sign(actions))
    if (aircraft, flight_control) == ("cessna172", "direct"):  # from 23 to -28 degrees
        assert lowest[:, envs.observation_names.index("elevator_fraction")].min() < -1.1


def test_what_a_task_file_scales_has_no_bound(tmp_path):
    text = (ROOT / "examples" / "tasks" / "level_turn.toml").read_text()
    file = tmp_path / "scaled.toml"
    file.write_text(text.replace("numbers = [", 'numbers = [\n  {quantity = "cos_beta", unit = 0.01},'))
    env = skein.make(str(file))
    assert "cos_beta_scaled" in env.observation_names
    assert env.observation_space.contains(env.reset(seed=1)[0])


def test_an_agent_that_does_not_fit_is_refused():
    control = skein.load_policy(ROOT / "policies" / "control.skein")
    heading = skein.load_policy(ROOT / "policies" / "heading.skein")
    with pytest.raises(skein.Error, match="control"):
        skein.make_vec("heading", 4, agent=control)
    with pytest.raises(skein.Error, match="aircraft"):
        skein.make("heading", preset="cessna172", agent=heading)


def test_arrays_are_written_once_and_actions_are_only_read():
    envs = skein.make_vec("heading", 32)
    envs.reset(seed=0)
    actions = random_actions(envs, 1)[0]
    actions.flags.writeable = False
    first, *_ = envs.step(actions)
    kept = first.copy()
    second, *_ = envs.step(actions.astype(np.float64))
    assert first.flags.owndata and first.flags.c_contiguous and first.dtype == np.float32
    assert not np.shares_memory(first, second)
    np.testing.assert_array_equal(first, kept)


def test_tensors_of_torch_are_actions():
    torch = pytest.importorskip("torch")
    envs, same = (skein.make_vec("heading", 32) for _ in range(2))
    actions = random_actions(envs, 1)[0]
    envs.reset(seed=0), same.reset(seed=0)
    observation, *_ = envs.step(torch.from_numpy(actions))
    np.testing.assert_array_equal(observation, same.step(actions)[0])
    assert torch.from_dlpack(observation).data_ptr() == observation.ctypes.data


class DLPackAlone:
    """An array of a library that NumPy cannot read by itself."""

    def __init__(self, array):
        self.array = array

    def __dlpack__(self, **options):
        return self.array.__dlpack__(**options)

    def __dlpack_device__(self):
        return self.array.__dlpack_device__()


def test_arrays_that_speak_dlpack_alone_are_actions_and_observations(heading_policy):
    envs, same = (skein.make_vec("heading", 32) for _ in range(2))
    actions = random_actions(envs, 1)[0]
    envs.reset(seed=0), same.reset(seed=0)
    observation, *_ = envs.step(DLPackAlone(actions))
    np.testing.assert_array_equal(observation, same.step(actions)[0])
    for observed in (observation, observation[0]):
        acted = heading_policy.act(DLPackAlone(observed))[0]
        np.testing.assert_array_equal(acted, heading_policy.act(observed)[0])
    with pytest.raises(skein.ConfigurationError, match="actions must be an array of numbers, not NoDevice"):
        envs.step(type("NoDevice", (), {"__dlpack__": DLPackAlone.__dlpack__})())


@pytest.mark.parametrize("shape", [(31, 4), (32, 3), (32,), (32, 4, 1)])
def test_actions_of_another_shape_are_refused(shape):
    envs = skein.make_vec("heading", 32)
    envs.reset(seed=0)
    with pytest.raises((skein.Error, TypeError)):
        envs.step(np.zeros(shape, np.float32))


def test_an_action_beyond_float32_is_clipped_as_any_other():
    beyond, clipped = skein.make_vec("heading", 4), skein.make_vec("heading", 4)
    for envs in (beyond, clipped):
        envs.reset(seed=3)
    actions = np.zeros((4, 4))
    actions[0] = [1e39, -1e39, 1e300, -1e300]
    steps = beyond.step(actions), clipped.step(actions.clip(-1, 1))
    np.testing.assert_array_equal(steps[0][0], steps[1][0])
    np.testing.assert_array_equal(steps[0][1], steps[1][1])


def test_an_action_that_is_not_finite_ends_its_episode_alone():
    envs = skein.make_vec("heading", 4)
    envs.reset(seed=0)
    actions = np.zeros((4, 4), np.float32)
    actions[2, 1] = np.nan
    *_, terminated, _, info = envs.step(actions)
    assert terminated.tolist() == [False, False, True, False]
    assert info["final_info"]["termination"][2] == "non_finite"


def test_a_high_level_policy_is_given_targets_to_set():
    envs = skein.make_vec("tracking", 4, preset="planner", low_level="autopilot")
    assert envs.action_names == ("target_pitch", "target_yaw", "target_speed")
    assert envs.targets().shape == (4, 3)
    with pytest.raises(skein.ConfigurationError, match="low-level"):
        skein.make_vec("tracking", 4, preset="planner")


def test_the_state_is_shown_by_name():
    envs = skein.make_vec("heading", 5, **{"env.observation_noise": 0})
    observation, _ = envs.reset(seed=0)
    state = envs.state()
    altitude = observation[:, envs.observation_names.index("altitude_scaled")]
    np.testing.assert_allclose(-state["down_ft"] * 0.3048 / 5000, altitude, rtol=1e-5)
    np.testing.assert_allclose(sum(state[q] ** 2 for q in ("q0", "qx", "qy", "qz")), 1, rtol=1e-5)


def test_threads_wait_for_one_another_where_they_share_an_environment():
    program = """
import threading, numpy as np, skein
envs = skein.make_vec("heading", 256, threads=2)
envs.reset(seed=0)
failures = []

def repeated(call):
    try:
        for i in range(60):
            call(i)
    except Exception as error:
        failures.append(error)

def begin(i):
    envs.reset(seed=i)
    envs.restore(envs.snapshot())
    envs.state(), envs.targets()

actions = np.ones((256, 4), np.float32)  # of which episodes end
calls = [begin, begin, lambda _: envs.step(actions), lambda _: envs.step(actions), lambda _: envs.reset()]
threads = [threading.Thread(target=repeated, args=(call,)) for call in calls]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
assert not failures, failures
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
