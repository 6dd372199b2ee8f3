# SPDX-License-Identifier: Apache-2.0
import copy
import pickle
import subprocess
import sys
from collections.abc import Mapping

import numpy as np
import pytest
from conftest import ROOT

import skein


def test_a_setting_may_be_written_flat_or_nested():
    flat = skein.configure("heading", **{"env.heading.dwell_s": 2})
    nested = skein.configure("heading", env={"heading": {"dwell_s": 2.0}})
    assert flat["env.heading.dwell_s"] == 2.0
    assert flat.to_toml() == nested.to_toml()


@pytest.mark.parametrize("value", [True, np.True_])
def test_scalars_of_numpy_are_values(value):
    config = skein.configure("heading", env={"truncate_at_time_limit": value, "hold_s": np.float32(0.5)})
    assert config["env.truncate_at_time_limit"] is True
    assert config["env.hold_s"] == 0.5


def test_every_setting_can_be_read_and_given_again():
    config = skein.configure("control", **{"run.seed": 7})
    again = skein.configure("control", **config.settings())
    assert again.to_toml() == config.to_toml()


def test_a_configuration_is_read_as_a_mapping():
    config = skein.configure("heading")
    settings = config.settings()
    assert list(config) == list(settings) and len(config) == len(settings)
    assert "env.hold_s" in config
    assert "env.hold" not in config and "env.control.dwell_s" not in config and 3 not in config
    assert isinstance(config, Mapping) and dict(config) == settings
    assert list(config.keys()) == list(settings) and list(config.values()) == list(settings.values())
    assert config.items() == settings.items()
    assert config.get("env.hold_s") == config["env.hold_s"]
    assert config.get("env.hold") is None and config.get("env.hold", 7) == 7
    for key in ("env.hold", "env.control.dwell_s"):
        with pytest.raises(KeyError, match=f"^settings: unknown key {key}; ") as raised:
            config[key]
        assert isinstance(raised.value, skein.ConfigurationError)
    for key in (3, None, b"env.hold_s"):
        with pytest.raises(TypeError, match="keys are texts, not") as raised:
            config[key]
        assert "\n" not in str(raised.value)


def test_configurations_are_equal_that_say_the_same():
    config, same = skein.configure("heading"), skein.configure("heading")
    assert config == same and hash(config) == hash(same) and config is not same
    assert config != skein.configure("heading", env={"hold_s": 0}) and config != skein.configure("control")
    assert config != config.to_toml() and config != None  # noqa: E711
    file = ROOT / "examples" / "tasks" / "level_turn.toml"
    assert skein.configure(file) == skein.configure(file) != skein.configure(file).evaluation()


def own_files(folder):
    """A task file with training tolerances, and an aircraft."""
    task, aircraft = folder / "mine.toml", folder / "mine.json"
    text = (ROOT / "examples" / "tasks" / "level_turn.toml").read_text()
    task.write_text(text)
    aircraft.write_text((ROOT / "data" / "f16" / "aircraft.json").read_text())
    return task, aircraft


def test_configurations_are_pickled_whole(tmp_path):
    task, aircraft = own_files(tmp_path)
    own = skein.configure(task, aircraft=aircraft, **{"run.seed": 3, "env.observation_noise": 0.1})
    configs = [skein.configure("control", preset="paper"), own, own.evaluation()]
    pickled = pickle.dumps(configs)
    task.unlink()
    aircraft.unlink()
    for config, again in zip(configs, pickle.loads(pickled), strict=True):
        assert again == config == copy.copy(config) == copy.deepcopy(config)
        assert again.to_toml() == config.to_toml()
    flies = (
        "import pickle, sys, skein\n"
        "for config in pickle.load(sys.stdin.buffer):\n"
        "    print(skein.evaluate('zero', config, episodes=4).return_mean)\n"
    )
    there = subprocess.run([sys.executable, "-c", flies], input=pickled, capture_output=True, check=True).stdout
    here = [skein.evaluate("zero", config, episodes=4).return_mean for config in configs]
    assert [float(line) for line in there.split()] == here


def test_an_aircraft_is_named_beside_the_settings():
    named = skein.make_vec("heading", 2, preset="aerosonde", aircraft="aerosonde")
    assert named.config["env.aircraft"] == "aerosonde"
    with pytest.raises(skein.ConfigurationError, match="no/aircraft.json"):
        skein.make_vec("heading", 2, aircraft="no/aircraft.json")


def test_the_file_of_an_aircraft_flies_as_its_name_does(tmp_path):
    file = tmp_path / "mine.json"
    file.write_text((ROOT / "data" / "cessna172" / "aircraft.json").read_text())
    by_file, by_name = (
        skein.evaluate("zero", "heading", preset="cessna172", aircraft=aircraft, episodes=8)
        for aircraft in (file, "cessna172")
    )
    for name, column in by_name.columns.items():
        np.testing.assert_array_equal(column, by_file.columns[name], err_msg=name)
    with pytest.raises(skein.ConfigurationError, match="preset cessna172"):
        skein.evaluate("zero", "heading", aircraft="cessna172", episodes=8)


def test_texts_may_have_any_character_of_a_line(tmp_path):
    folder = tmp_path / "\U0001f6e9 \u00e9\\"
    folder.mkdir()
    _, aircraft = own_files(folder)
    for config in (
        skein.configure("heading", aircraft=aircraft),
        skein.configure("heading", **{"env.aircraft": str(aircraft)}),
    ):
        assert skein.evaluate("zero", config, episodes=4).summary["episodes"] == 4


def test_settings_lie_on_top_of_conditions_and_presets():
    paper = skein.configure("heading", preset="paper", conditions={"noisy": "0.03"})
    assert paper["env.observation_noise"] == 0.03
    assert skein.configure(paper, **{"env.observation_noise": 0})["env.observation_noise"] == 0
    assert paper["env.observation_noise"] == 0.03  # a Config does not change
    assert "paper" in skein.presets("heading")


def test_a_file_lies_on_top_of_a_config_and_settings_on_top_of_it(tmp_path):
    file = tmp_path / "noise.toml"
    file.write_text("env.observation_noise = 0.03\nenv.hold_s = 2\n")
    paper = skein.configure("heading", preset="paper", env={"observation_noise": 0.01})
    on_top = skein.configure(paper, file=file, env={"hold_s": 1})
    assert (on_top["env.observation_noise"], on_top["env.hold_s"]) == (0.03, 1)
    assert on_top == skein.configure(paper, env={"observation_noise": 0.03, "hold_s": 1})
    with pytest.raises(skein.ConfigurationError, match="preset is for the name of a task"):
        skein.configure(paper, preset="easy")


@pytest.mark.parametrize(
    ("settings", "says"),
    [
        ({"env.heading.dwel_s": 1}, "did you mean env.heading.dwell_s"),
        ({"env": {"observation_noise": -1}}, "out of range"),
        ({"env.action_repeat": "often"}, "must be an integer"),
        ({"env.control.dwell_s": 1}, "is of task control"),
        ({"env.hold_s": [1]}, "must be a number"),
        ({"preset": "papr"}, "papr"),
        ({"conditions": ["windy"]}, "expected NAME=LEVEL"),
    ],
)
def test_what_cannot_be_is_a_typed_exception(settings, says):
    with pytest.raises(skein.ConfigurationError, match=says) as raised:
        skein.make_vec("heading", 1, **settings)
    assert isinstance(raised.value, skein.Error)
    assert isinstance(raised.value, ValueError)
    assert "\n" not in str(raised.value)


def test_an_unknown_task_names_the_known_ones():
    with pytest.raises(skein.ConfigurationError, match="heading"):
        skein.make("aerobatics")
    with pytest.raises(skein.ConfigurationError, match="task hedding.*did you mean heading.*known tasks: "):
        skein.presets("hedding")
    assert skein.presets(str(ROOT / "examples" / "tasks" / "level_turn.toml")) == []
