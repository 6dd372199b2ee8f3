# SPDX-License-Identifier: Apache-2.0
"""Arguments that cannot be: one typed exception with one line, and nothing else happens."""
import random

import numpy as np
import pytest

import skein

HOSTILE = [
    None, True, -1, 0, 1, 2.5, 10**30, -(10**30), float("nan"), float("inf"), "", "heading", "x" * 5000, "a\nb", "a\0b",
    "a\ud800", b"bytes", [], [1], [[1, 2], [3]], {}, {"a": 1}, {"env": {"env": {}}}, object(), np.zeros(0),
    np.zeros((4, 4)),
    np.zeros((2, 2), complex), np.full((4, 4), np.nan), np.array("text"), np.zeros((3, 4), object), lambda at: None,
]
CALLS = 3000


def typed(call, *args, **kwargs):
    """Whether the call was refused, which must be done as promised."""
    try:
        call(*args, **kwargs)
    except skein.Error as error:
        assert str(error)
        assert "\n" not in str(error).strip(), (call, args, kwargs, str(error))
        return True
    return False


def calls(tmp_path, policy):
    envs, env = skein.make_vec("heading", 4), skein.make("heading")
    envs.reset(seed=0)
    trim = skein.trim(15000, 500)
    below = tmp_path / "a file"
    below.write_text("")
    return [
        (lambda a, b: skein.make_vec(a, b), 2),
        (lambda a, b: skein.make_vec("heading", 2, threads=a, low_level=b), 2),
        (lambda a, b: skein.make_vec("heading", 2, preset=a, conditions=b), 2),
        (lambda a, b: skein.make_vec("heading", 2, file=a, agent=b), 2),
        (lambda a, b: skein.make("control", env=a, reward=b), 2),
        (lambda a, b: skein.make("heading", reward=a, terminated=b), 2),
        (lambda a: skein.configure("heading", **{"env.heading.dwell_s": a}), 1),
        (lambda a: skein.configure("heading", **{"env.aircraft": a}), 1),
        (lambda a: skein.configure(a), 1),
        (lambda a: skein.presets(a), 1),
        (lambda a: envs.step(a), 1),
        (lambda a: envs.reset(seed=a), 1),
        (lambda a: envs.reset(options={"reset_mask": a}), 1),
        (lambda a: envs.restore(a), 1),
        (lambda a: (env.reset(seed=0), env.step(a)), 1),
        (lambda a, b: policy.act(a, b), 2),
        (lambda a: policy.act(np.zeros(22), policy_step=a), 1),
        (lambda a: skein.load_policy(a), 1),
        (lambda a: skein.Agent(a), 1),
        (lambda a, b: skein.evaluate("zero", "heading", episodes=a, seed=b), 2),
        (lambda a: skein.evaluate(a, "heading", episodes=2), 1),
        (lambda a, b: skein.trim(a, b), 2),
        (lambda a, b: skein.trim(15000, 500, aircraft=a, atmosphere=b), 2),
        (lambda a, b: skein.trim(15000, 500, cg=a, turn_rate_deg_s=b), 2),
        (lambda a, b: skein.simulate(trim, a, duration_s=b), 2),
        (lambda a, b: skein.simulate(trim, trim.controls, duration_s=a, state=b), 2),
        (lambda a: skein.simulate(a, trim.controls, duration_s=1), 1),
        (lambda a: skein.linearise(a), 1),
        (lambda a: skein.compare(a, "heading", episodes=2), 1),
        (lambda a: skein.Run(a), 1),
        (lambda a: skein.train("heading", below, callback=a), 1),
        (lambda a: skein.train("heading", below, low_level=a, threads=1), 1),
    ]


def test_hostile_arguments_are_refused_with_a_line(tmp_path, heading_policy, monkeypatch):
    monkeypatch.chdir(tmp_path)
    draw = random.Random(1)
    refused = 0
    functions = calls(tmp_path, heading_policy)
    for i in range(CALLS):
        call, count = functions[i % len(functions)]
        refused += typed(call, *(draw.choice(HOSTILE) for _ in range(count)))
    assert refused > CALLS / 2
    assert [path.name for path in tmp_path.iterdir()] == ["a file"]


@pytest.mark.parametrize("name", ["reward", "terminated"])
def test_what_is_no_function_does_not_reward_or_terminate(name):
    for value in (False, *HOSTILE):
        if value is not None and not callable(value):
            with pytest.raises(skein.ConfigurationError, match=f"{name} must be a function of columns"):
                skein.make("heading", **{name: value})


def test_a_function_may_look_empty():
    class Empty:
        def __len__(self):
            return 0

        def __call__(self, at):
            return -np.ones_like(at["reward"])

    env = skein.make("heading", reward=Empty())
    env.reset(seed=0)
    assert env.step(np.zeros(4))[1] == -1


@pytest.mark.parametrize("make", [lambda: skein.make_vec("heading", 2), lambda: skein.make("heading")])
def test_a_closed_environment_says_so(make):
    envs = make()
    envs.reset(seed=0)
    envs.close()
    envs.close()
    with pytest.raises(skein.Error, match="closed"):
        envs.step(np.zeros(envs.action_space.shape))
    with pytest.raises(skein.Error, match="closed"):
        envs.reset()


def test_a_step_needs_a_reset():
    with pytest.raises(skein.Error, match="reset"):
        skein.make_vec("heading", 2).step(np.zeros((2, 4)))
    with pytest.raises(skein.Error, match="reset begins the first episode"):
        skein.make("heading").step(np.zeros(4))


def test_a_number_of_aircraft_of_numpy_is_one_of_python():
    assert type(skein.make_vec("heading", np.uint8(3)).num_envs) is int


def test_an_unknown_option_of_a_reset_may_have_any_name():
    with pytest.raises(skein.ConfigurationError, match="unknown option 1"):
        skein.make_vec("heading", 2).reset(options={1: 2, "a": 3})


def test_what_another_library_says_of_an_array_is_passed_on():
    class Tensor:
        """As one of torch that requires gradients."""

        dtype = "torch.float32"

        def __array__(self, *_, **__):
            raise RuntimeError("Can't call numpy() on Tensor that requires grad.\nUse tensor.detach().numpy() instead.")

    envs = skein.make_vec("heading", 2)
    envs.reset(seed=0)
    with pytest.raises(skein.ConfigurationError, match=r"Tensor of torch.float32: .* Use tensor.detach\(\)"):
        envs.step(Tensor())


def test_what_is_refused_is_also_a_value_error():
    envs = skein.make_vec("heading", 2)
    envs.reset(seed=0)
    for wrong in (np.zeros((2, 5)), np.zeros((2, 4), complex), "actions"):
        with pytest.raises(ValueError, match="actions must"):
            envs.step(wrong)


def test_keys_are_texts_in_a_few_tables():
    with pytest.raises(skein.ConfigurationError, match="key must be a text, not 1"):
        skein.configure("heading", env={1: 2})
    endless = {}
    endless["env"] = endless
    with pytest.raises(skein.ConfigurationError, match="more than 8 tables"):
        skein.configure("heading", **endless)


def test_a_flight_that_leaves_the_numbers_says_at_which_step():
    trim = skein.trim(15000, 500)
    controls = np.tile(trim.controls, (5, 1))
    controls[3, 1] = np.nan
    with pytest.raises(skein.Error, match="not finite after step 4 of 5"):
        skein.simulate(trim, controls)
