# SPDX-License-Identifier: Apache-2.0
"""Learners of others fly through the package. Trainings are long checks (scripts/test_python --all)."""
import json
import subprocess
import sys
import warnings

import numpy as np
import pytest
from conftest import ROOT

import skein

# Of 500 fresh episodes: well below what one seed of each reached (docs/how-to/python.md: 0.93 the least), far above what
# learns nothing; actions of zero reach 0.12, random ones 0.39.
LEAST_SUCCESS = 0.85


def test_the_easy_preset_is_not_won_by_doing_nothing():
    shares = {name: skein.evaluate(name, "heading", preset="easy", episodes=200).success_rate for name in ("zero", "autopilot")}
    assert shares["zero"] < 0.2
    assert shares["autopilot"] > 0.95


def test_the_adapter_says_what_the_environment_does():
    pytest.importorskip("stable_baselines3")
    import skein.sb3

    settings = {"env.time_limit_steps": 100, "env.action_repeat": 5}
    envs, adapter = (skein.make_vec("heading", 20, preset="easy", **settings) for _ in range(2))
    adapter = skein.sb3.VecEnv(adapter)
    adapter.seed(4)
    np.testing.assert_array_equal(adapter.reset(), envs.reset(seed=4)[0])
    draw = np.random.default_rng(0)
    ends = 0
    for _ in range(40):
        actions = draw.uniform(-1, 1, (20, 4)).astype(np.float32)
        observation, reward, over, infos = adapter.step(actions)
        expected = envs.step(actions)
        np.testing.assert_array_equal(observation, expected[0])
        np.testing.assert_array_equal(reward, expected[1])
        np.testing.assert_array_equal(over, expected[2] | expected[3])
        for i in np.flatnonzero(over):
            assert infos[i]["TimeLimit.truncated"] == expected[3][i]
            np.testing.assert_array_equal(infos[i]["terminal_observation"], expected[4]["final_obs"][i])
            assert infos[i]["episode"]["l"] <= 20
            ends += 1
    assert ends >= 20
    assert adapter.get_attr("num_envs", [0, 3]) == [20, 20]


def test_stable_baselines_makes_the_environment_by_its_name():
    pytest.importorskip("stable_baselines3")
    from stable_baselines3 import PPO
    from stable_baselines3.common.env_util import make_vec_env

    envs = make_vec_env("skein/Heading-v0", n_envs=2, env_kwargs={"preset": "easy"})
    assert envs.reset().shape == (2, 22)
    assert PPO("MlpPolicy", "skein/Heading-v0", device="cpu").get_env().num_envs == 1


def test_the_adapter_takes_many_aircraft_alone():
    pytest.importorskip("stable_baselines3")
    import skein.sb3

    for wrong in (skein.make("heading"), "heading"):
        with pytest.raises(skein.ConfigurationError, match="envs must be what skein.make_vec gives, not "):
            skein.sb3.VecEnv(wrong)


def test_stable_baselines_evaluates_by_the_returns_of_the_environment():
    pytest.importorskip("stable_baselines3")
    from stable_baselines3.common.evaluation import evaluate_policy
    from stable_baselines3.common.vec_env import VecNormalize

    import skein.sb3

    class Idle:
        def predict(self, observation, state=None, episode_start=None, deterministic=False):
            return np.zeros((len(observation), 4), np.float32), None

    settings = {"env.time_limit_steps": 100, "env.action_repeat": 5, "env.stagger_clocks": False}
    envs = skein.make_vec("heading", 4, preset="easy", **settings)
    envs.reset(seed=4)
    expected, over = np.zeros(4), np.zeros(4, bool)
    while not over.all():
        *_, terminated, truncated, info = envs.step(np.zeros((4, 4), np.float32))
        for i in np.flatnonzero((terminated | truncated) & ~over):
            expected[i] = info["final_info"]["episode_return"][i]
        over |= terminated | truncated
    adapter = skein.sb3.VecEnv(skein.make_vec("heading", 4, preset="easy", **settings))
    normalised = VecNormalize(adapter)
    normalised.seed(4)
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # of an environment without Monitor
        returns, _ = evaluate_policy(Idle(), normalised, n_eval_episodes=4, return_episode_rewards=True)
    np.testing.assert_allclose(np.sort(returns), np.sort(expected), rtol=1e-6)
    assert adapter.env_is_wrapped(VecNormalize, [0, 3]) == [False, False]


def learnt(tmp_path, example, *arguments):
    out = tmp_path / "curve.json"
    command = [sys.executable, ROOT / "examples" / "python" / example, "--json", out, *arguments]
    subprocess.run(command, check=True)
    return json.loads(out.read_text())


@pytest.mark.parametrize("example", ["ppo_heading.py", "sb3_heading.py"])
@pytest.mark.parametrize(
    "option,says", [("--json={}/no/curve.json", "no/curve.json"), ("--aircraft=0", "num_envs must")]
)
def test_an_example_that_cannot_end_well_does_not_begin(tmp_path, example, option, says):
    pytest.importorskip("sb3_contrib")
    pytest.importorskip("torch")
    command = [sys.executable, ROOT / "examples" / "python" / example, option.format(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 1 and done.stdout == ""
    assert says in done.stderr and done.stderr.count("\n") == 1


@pytest.mark.long
@pytest.mark.parametrize("arguments", [["ppo_heading.py"], ["sb3_heading.py"], ["sb3_heading.py", "--recurrent"]])
def test_a_learner_of_others_learns_the_easy_preset(tmp_path, arguments):
    pytest.importorskip("sb3_contrib")
    pytest.importorskip("torch")
    assert learnt(tmp_path, *arguments)["success_rate"] > LEAST_SUCCESS
