# SPDX-License-Identifier: Apache-2.0
"""What the program says in the words of its command line is said in those of Python: arguments, not options."""
import inspect

import pytest
from conftest import ROOT

import skein
from skein.messages import words_of_python

TASK_FILE = ROOT / "examples" / "tasks" / "level_turn.toml"
SHORT = {"run.total_steps": 1, "network": {"hidden_size": 8, "gru_size": 8},
         "ppo": {"num_aircraft": 32, "rollout_steps": 8, "chunk_length": 8, "minibatches": 1}}


def refusal(call):
    with pytest.raises(skein.Error) as raised:
        call()
    return str(raised.value)


@pytest.mark.parametrize("call,says", [
    (lambda policy: skein.make("heading", conditions=["winddy"]), "conditions winddy: expected"),
    (lambda policy: skein.make("heading", conditions={"windy": None}), "conditions windy=None: cannot read"),
    (lambda policy: skein.configure(skein.configure("heading"), conditions=["winddy"]), "conditions winddy: expected"),
    (lambda policy: skein.make("heading", low_level="autopilot"), "low_level is for"),
    (lambda policy: skein.make_vec("tracking", 2, preset="planner"), "needs low_level RUN_OR_POLICY"),
    (lambda policy: skein.train("tracking", "run", preset="planner", progress=False), "or low_level autopilot"),
    (lambda policy: skein.make("heading", aircraft="cessna172"), "use preset cessna172, .* by settings, a file or in"),
    (lambda policy: skein.make(TASK_FILE, preset="easy"), "its own settings, and a file others"),
    (lambda policy: skein.evaluate(policy, preset="cessna172", episodes=2), "policy:FILE@other-aircraft allows"),
    (lambda policy: skein.make("heading", env={"zzz": 1}), r"skein.configure\(TASK\).settings\(\) has all keys"),
    (lambda policy: skein.configure("heading")["zzz"], r"skein.configure\(TASK\).settings\(\) has all keys"),
])
def test_a_refusal_names_arguments(call, says, heading_policy, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    said = refusal(lambda: call(heading_policy))
    assert "--" not in said
    with pytest.raises(skein.Error, match=says):
        call(heading_policy)


def test_a_directory_in_use_is_refused_in_words_of_python(tmp_path):
    def train():
        skein.train("heading", tmp_path / "run", threads=1, progress=False, **SHORT, **{"evaluation.final_episodes": 1})

    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "a file").touch()
    assert refusal(train).endswith("choose another out")
    (tmp_path / "run" / "a file").unlink()
    train()
    resume = f"skein.Run({str(tmp_path / 'run')!r}).resume()"
    assert refusal(train).endswith(f"continue it with {resume}, or choose another out")


@pytest.mark.parametrize("said", ["/runs--out/a: is missing", "a --outer one", "out--out", "--seed 1"])
def test_what_is_no_option_of_an_argument_stays(said):
    assert words_of_python(said) == said


@pytest.mark.parametrize("name,says", [
    ("condition", "there is no argument condition; did you mean conditions"),
    ("presets", "did you mean preset"),
    ("seed", "reset takes an environment's; run.seed is that of a training"),
    ("max_episode_steps", "env.time_limit_steps is that of an episode, in control steps"),
    ("threads", "threads is neither an argument of this function nor a setting"),
    ("num_envs", "num_envs is neither"),
    ("action_repeat", "did you mean env.action_repeat"),
])
def test_an_argument_that_is_none_is_told_from_a_setting(name, says):
    with pytest.raises(skein.ConfigurationError, match=says):
        skein.make("heading", **{name: 1})


def test_an_argument_that_is_not_taken_is_a_type_error_too():
    for name in ("condition", "seed", "threads"):
        with pytest.raises(TypeError, match=name):
            skein.make("heading", **{name: 1})


def test_the_path_of_a_policy_is_told_from_an_agent():
    file = ROOT / "policies" / "heading.skein"
    for path in (file, str(file)):
        with pytest.raises(skein.ConfigurationError, match="evaluate: .* is a path and no agent: skein.load_policy"):
            skein.evaluate(path, episodes=2)
    with pytest.raises(skein.ConfigurationError, match="skein.load_policy makes one of a file.*not PosixPath"):
        skein.compare([file], "heading", episodes=2)


def test_levels_of_conditions_may_be_numbers_by_their_types_too():
    by_number = skein.configure("heading", conditions={"noisy": 0.03})
    assert by_number == skein.configure("heading", conditions=["noisy=0.03"])
    for function in (skein.configure, skein.make, skein.make_vec):
        annotation = inspect.signature(function).parameters["conditions"].annotation
        assert annotation == "Sequence[str] | Mapping[str, str | float]"


@pytest.mark.parametrize(
    "call",
    [
        lambda: skein.make("heading", evaluation="no"),
        lambda: skein.make_vec("heading", 4, evaluation=1),
        lambda: skein.train("heading", "unused", progress="no"),
        lambda: skein.load_policy(ROOT / "policies" / "heading.skein", sampled="no"),
    ],
)
def test_a_truth_value_is_one(call):
    with pytest.raises(skein.ConfigurationError, match="(evaluation|progress|sampled) must be True or False, not "):
        call()


def test_a_run_is_told_from_its_policy(tmp_path):
    (tmp_path / "config.toml").write_text("")
    with pytest.raises(skein.ConfigurationError, match="evaluate: a run is no agent: its policy is"):
        skein.evaluate(skein.Run(tmp_path))
