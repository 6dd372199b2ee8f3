# SPDX-License-Identifier: Apache-2.0
import copy
import pickle
import shutil
import threading
from functools import partial

import numpy as np
import pytest
from conftest import ROOT

import skein

# What evaluations add to a seed, so that their episodes are not those of a training.
EVALUATION_STREAM = 0xA5B35705E7C0FFEE
EPISODES = 48


def assert_same_columns(first, second):
    assert first.starts == second.starts
    for name, column in first.columns.items():
        np.testing.assert_array_equal(column, second.columns[name], err_msg=name)


def test_an_evaluation_can_be_flown_again_from_python_to_the_bit(heading_policy):
    flown = skein.evaluate(heading_policy, episodes=EPISODES, seed=11)
    envs = skein.make_vec("heading", EPISODES, agent=heading_policy, evaluation=True)
    observation, _ = envs.reset(seed=11 ^ EVALUATION_STREAM)
    state = heading_policy.initial_state(EPISODES)
    returns, steps, ends = np.zeros(EPISODES, np.float32), np.zeros(EPISODES, np.int32), np.zeros(EPISODES, np.uint8)
    while not ends.all():
        actions, state = heading_policy.act(observation, state)
        observation, _, terminated, truncated, info = envs.step(actions)
        over = terminated | truncated
        state[over] = 0
        for i in np.flatnonzero(over & (ends == 0)):
            ends[i] = info["termination"][i]
            returns[i] = info["final_info"]["episode_return"][i]
            steps[i] = info["final_info"]["episode_control_steps"][i]
    np.testing.assert_array_equal(ends, flown.columns["termination"])
    np.testing.assert_array_equal(returns, flown.columns["episode_return"])
    np.testing.assert_array_equal(steps, flown.columns["control_steps"])


def test_a_function_around_a_policy_flies_as_the_policy_does(heading_policy):
    def around(observation, state):
        return heading_policy.act(observation, state)

    around.state_size = heading_policy.state_size
    around.action_repeat = heading_policy.action_repeat
    assert_same_columns(
        skein.evaluate(heading_policy, episodes=EPISODES, seed=1),
        skein.evaluate(around, "heading", episodes=EPISODES, seed=1, threads=2),
    )


def test_one_aircraft_is_flown_as_many_are(heading_policy):
    draw = np.random.default_rng(0)
    observation = draw.normal(size=(3, 22)).astype(np.float32)
    actions, state = heading_policy.act(observation)
    action, one_state = heading_policy.act(observation[1])
    np.testing.assert_array_equal(action, actions[1])
    np.testing.assert_array_equal(one_state[0], state[1])
    again, _ = heading_policy.act(observation, state)
    assert not np.array_equal(again, actions)  # it remembers


def sampled_policy(seed=0):
    return skein.load_policy(ROOT / "policies" / "heading.skein", sampled=True, seed=seed)


@pytest.mark.parametrize("make", [sampled_policy, lambda seed=0: skein.Agent("random", "heading", seed=seed)])
def test_an_agent_that_draws_is_told_the_policy_step(make):
    agent, observation = make(), np.zeros((3, 22), np.float32)
    assert agent.draws
    with pytest.raises(skein.ConfigurationError, match="policy_step is needed"):
        agent.act(observation)
    first, second, again, other = (
        acting.act(observation, policy_step=step)[0]
        for acting, step in ((agent, 0), (agent, 1), (make(), 0), (make(seed=1), 0))
    )
    np.testing.assert_array_equal(first, again)
    assert (first != second).all() and (first != other).all()
    assert len(np.unique(first[:, 0])) == 3  # each row draws its own


def test_the_mean_of_a_policy_does_not_depend_on_the_policy_step(heading_policy):
    observation = np.zeros(22, np.float32)
    assert not heading_policy.draws
    np.testing.assert_array_equal(heading_policy.act(observation)[0], heading_policy.act(observation, policy_step=7)[0])
    assert not skein.Agent("zero").draws and not skein.Agent("autopilot").draws
    file = ROOT / "policies" / "heading.skein"
    assert skein.Agent(f"policy:{file}@sampled@other-aircraft").draws and not skein.Agent(f"policy:{file}").draws


def test_agents_are_pickled_and_copied(heading_policy):
    observation = np.random.default_rng(0).normal(size=(5, 22)).astype(np.float32)
    for agent in (heading_policy, sampled_policy(seed=3), skein.Agent("random:0.5", seed=3), skein.Agent("autopilot")):
        assert copy.copy(agent) is agent and copy.deepcopy(agent) is agent
        again = pickle.loads(pickle.dumps(agent))
        assert (again.name, again.action_repeat, again.draws) == (agent.name, agent.action_repeat, agent.draws)
        for a, b in zip(agent.act(observation, policy_step=4), again.act(observation, policy_step=4), strict=True):
            np.testing.assert_array_equal(a, b)


def test_agents_are_compared_on_the_same_episodes(heading_policy):
    def idle(observation):
        return np.zeros((len(observation), 4), np.float32)

    compared = skein.compare(
        {"policy": heading_policy, "autopilot": "autopilot", "idle": idle}, "heading", episodes=EPISODES
    )
    rates = {agent["name"]: agent["success_rate"] for agent in compared.summary["agents"]}
    assert rates["policy"] > rates["idle"] == 0
    assert "policy" in str(compared)
    assert repr(compared) == f"Comparison(heading, {EPISODES} episodes: policy, autopilot, idle)"
    assert repr(skein.evaluate("zero", "heading", episodes=4)).startswith("Evaluation(4 episodes, success 0.0 %, nan s")
    assert len({agent["name"] for agent in compared.summary["agents"]}) == 3
    assert compared.summary["program"]["version"] == skein.__version__


def test_agents_of_the_same_name_are_not_compared():
    def idle(observation):
        return np.zeros((len(observation), 4), np.float32)

    for twice in (["zero", "autopilot", "zero"], [idle, idle], {1: "zero", "1": idle}):
        with pytest.raises(skein.ConfigurationError, match="compare: .* is there twice: use a dict to name the agents"):
            skein.compare(twice, "heading", episodes=4)


def test_autopilots_fly_by_name():
    autopilot = skein.Agent("autopilot:traditional", "heading")
    assert autopilot.action_size == 4
    flown = skein.evaluate(autopilot, "heading", episodes=EPISODES)
    assert_same_columns(flown, skein.evaluate("autopilot:traditional", "heading", episodes=EPISODES))


def test_autopilots_fly_their_own_task_alone():
    with pytest.raises(skein.Error, match="control"):
        skein.evaluate(skein.Agent("autopilot", "control"), "heading", episodes=4)
    with pytest.raises(skein.Error, match="cessna172"):
        skein.evaluate(skein.Agent("autopilot", "heading"), "heading", preset="cessna172", episodes=4)


def test_untrained_networks_are_an_agent():
    untrained = skein.Agent("policy:untrained", "heading")
    assert untrained.name == "policy:untrained"
    assert skein.evaluate(untrained, "heading", episodes=4).summary["success_rate"] == 0


def test_flights_are_tables(heading_policy):
    pytest.importorskip("pandas")
    flights = skein.record(heading_policy, count=2, observations=True)
    assert sorted(flights["episode"].unique()) == [0, 1]
    flown = skein.evaluate(heading_policy, episodes=2)
    assert (flights.groupby("episode").size() - 1).tolist() == flown.columns["control_steps"].tolist()
    assert flown.to_pandas()["termination"].tolist() == flights.groupby("episode")["termination"].last().tolist()


HOLD_S, CONTROL_STEP_S = 2, 0.02
FLOAT32 = {"rtol": 1e-5, "atol": 1e-4}  # of each flight: recorded flights have seven digits
MEAN_OF_FLOAT32 = {"rel": 1e-4, "abs": 1e-4}


@pytest.fixture(scope="module")
def held_flights(heading_policy):
    """Flights as they are measured, and their states after every control step: the initial one does not count."""
    pytest.importorskip("pandas")
    flown = skein.evaluate(heading_policy, episodes=3, env={"hold_s": HOLD_S})
    flights = skein.record(heading_policy, count=3, env={"hold_s": HOLD_S})
    assert (flights.groupby("episode")["termination"].last() == "target_reached").all()
    return flown, [flight for _, flight in flights[flights["time_s"] > 0].groupby("episode")]


def assert_measured(flown, expected, has_columns=True):
    """What an evaluation has of all flights in its summary, and of each, if it has columns of that."""
    for name, values in expected.items():
        if has_columns:
            np.testing.assert_allclose(flown.columns[name], values, **FLOAT32, err_msg=name)
        mean = flown.summary["estimates"][name]["value"]
        assert mean == pytest.approx(np.mean(values), **MEAN_OF_FLOAT32), name


def test_peaks_are_those_of_the_recorded_flights(held_flights):
    flown, flights = held_flights
    peaks = {
        "peak_load_factor_g": [flight["load_factor_g"].max() for flight in flights],
        "lowest_load_factor_g": [flight["load_factor_g"].min() for flight in flights],
        "peak_alpha_deg": [flight["alpha_deg"].max() for flight in flights],
        "peak_abs_beta_deg": [flight["beta_deg"].abs().max() for flight in flights],
        "peak_abs_p_deg_s": [flight["p_deg_s"].abs().max() for flight in flights],
    }
    assert_measured(flown, peaks)
    for name, values in peaks.items():
        worst = min(values) if name == "lowest_load_factor_g" else max(values)
        assert flown.summary["estimates"][name + "_worst"]["value"] == pytest.approx(worst, **MEAN_OF_FLOAT32)


# What docs/reference/metrics.md says that a mean over the states of a flight is of.
FLIGHT_METRICS = {
    "load_factor_g": lambda flight: flight["load_factor_g"],
    "true_airspeed_fps": lambda flight: flight["true_airspeed_fps"],
    "mach": lambda flight: flight["mach"],
    "abs_alpha_deg": lambda flight: flight["alpha_deg"].abs(),
    "abs_beta_deg": lambda flight: flight["beta_deg"].abs(),
    "abs_p_rad_s": lambda flight: np.radians(flight["p_deg_s"].abs()),
    "abs_q_rad_s": lambda flight: np.radians(flight["q_deg_s"].abs()),
    "abs_r_rad_s": lambda flight: np.radians(flight["r_deg_s"].abs()),
    "altitude_margin": lambda flight: (flight["altitude_ft"] - 2500) / (5000 / 0.3048),
    "speed_margin": lambda flight: (1.505 - (flight["mach"] - 1.505).abs()) / 1.505,
    "overload_margin": lambda flight: (10 - flight["load_factor_g"].abs()) / 10,
    "alpha_margin": lambda flight: (32.5 - (flight["alpha_deg"] - 12.5).abs()) / 32.5,
    "beta_margin": lambda flight: (30 - flight["beta_deg"].abs()) / 30,
}


def test_flight_metrics_are_means_over_the_recorded_flights(held_flights):
    flown, flights = held_flights
    assert_measured(flown, {
        name: [value(flight).mean() for flight in flights] for name, value in FLIGHT_METRICS.items()
    })


def test_metrics_of_the_hold_are_those_of_the_end_of_the_recorded_flights(held_flights):
    flown, flights = held_flights
    holds = [flight.tail(round(HOLD_S / CONTROL_STEP_S)) for flight in flights]
    squared = ["p_deg_s", "q_deg_s", "r_deg_s", "beta_deg"]
    squared += ["error_altitude_ft", "error_yaw_deg", "error_true_airspeed_fps"]
    expected = {f"hold_rms_{name}": [np.sqrt((hold[name] ** 2).mean()) for hold in holds] for name in squared}
    expected["hold_abs_bank_deg"] = [hold["roll_deg"].abs().mean() for hold in holds]
    expected["hold_load_factor_deviation_g"] = [hold["load_factor_g"].std(ddof=0) for hold in holds]
    assert_measured(flown, expected, has_columns=False)


def test_a_function_sees_what_a_task_file_shows():
    file = ROOT / "examples" / "tasks" / "level_turn.toml"
    shapes = set()

    def turn(observation):
        shapes.add(observation.shape[1])
        return np.zeros((len(observation), 4), np.float32)

    skein.evaluate(turn, str(file), episodes=4)
    assert shapes == {skein.make_vec(str(file), 1).single_observation_space.shape[0]} == {27}


@pytest.mark.parametrize("fly", [
    partial(skein.evaluate, episodes=300),
    partial(skein.record, count=2),
    lambda agent, task, threads: skein.compare([agent], task, episodes=300, threads=threads),
])
def test_one_thread_calls_a_function_in_that_of_the_caller(fly):
    callers = set()

    def zero(observation):
        callers.add(threading.get_ident())
        return np.zeros((len(observation), 4), np.float32)

    fly(zero, "heading", threads=1)
    assert callers == {threading.get_ident()}
    assert "threads=1: one at a time, in the caller's" in (ROOT / "docs" / "reference" / "python-api.md").read_text()


def test_what_a_function_raises_comes_through():
    def broken(observation):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        skein.evaluate(broken, "heading", episodes=4)


@pytest.mark.parametrize("returned", [None, np.zeros((3, 4), np.float32), "actions"])
def test_what_a_function_returns_must_be_actions(returned):
    with pytest.raises(skein.Error, match=r"array of shape \(4, 4\)"):
        skein.evaluate(lambda observation: returned, "heading", episodes=4)


def test_what_a_function_returns_must_be_real():
    with pytest.raises(skein.Error, match=r"returned ndarray of complex128 and shape \(4, 4\)"):
        skein.evaluate(lambda observation: np.zeros((4, 4), complex), "heading", episodes=4)


def test_names_of_agents_are_of_one_line():
    with pytest.raises(skein.ConfigurationError, match="name of an agent must be a text"):
        skein.compare({"mine\nand more": "zero"}, "heading", episodes=4)


def test_files_that_are_no_policies_are_refused(tmp_path):
    file = tmp_path / "not.skein"
    file.write_bytes(b"not a policy")
    with pytest.raises(skein.Error, match="not.skein"):
        skein.load_policy(file)
    with pytest.raises(skein.Error):
        skein.load_policy(tmp_path / "missing.skein")
    with pytest.raises(skein.ConfigurationError, match="path must name a policy"):
        skein.load_policy("")


def test_a_policy_brings_its_task_by_its_name_too():
    file = ROOT / "policies" / "control.skein"
    by_name, by_file = (skein.evaluate(agent, episodes=8) for agent in (f"policy:{file}", skein.load_policy(file)))
    assert_same_columns(by_name, by_file)
    for name in ("policy:untrained", "autopilot", "zero"):
        with pytest.raises(skein.ConfigurationError, match="evaluate: task is needed"):
            skein.evaluate(name, episodes=8)


@pytest.fixture(scope="module")
def cessna_run(tmp_path_factory):
    settings = {
        "network": {"hidden_size": 8, "gru_size": 8},
        "ppo": {"num_aircraft": 32, "rollout_steps": 8, "chunk_length": 8, "minibatches": 1},
        "run.total_steps": 32 * 8 * 5,
        "evaluation.final_episodes": 4,
        "env.heading.dwell_s": 7,
    }
    folder = tmp_path_factory.mktemp("cessna")
    return skein.train("heading", folder / "run", preset="cessna172", progress=False, **settings)


def test_a_policy_of_a_run_brings_what_the_run_flies(cessna_run):
    expected = skein.evaluate(cessna_run.policy, cessna_run.config, episodes=8)
    assert cessna_run.config["env.heading.dwell_s"] == 7
    for agent in (cessna_run.policy, f"policy:{cessna_run.path}"):
        assert_same_columns(skein.evaluate(agent, episodes=8), expected)
    other = skein.evaluate(cessna_run.policy, episodes=8, conditions={"windy": "60fps"})
    by_config = skein.evaluate(cessna_run.policy, cessna_run.config, episodes=8, conditions={"windy": "60fps"})
    assert_same_columns(other, by_config)


def test_a_policy_of_a_run_remembers_what_the_run_flies(cessna_run, tmp_path, monkeypatch):
    expected = skein.evaluate(cessna_run.policy, episodes=8)
    shutil.copytree(cessna_run.path, tmp_path / "run")
    monkeypatch.chdir(tmp_path)
    agents = skein.load_policy("run"), skein.Agent("policy:run", preset="cessna172")
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    for agent in agents:
        assert_same_columns(skein.evaluate(agent, episodes=8), expected)
    shutil.rmtree(tmp_path / "run")
    for agent in agents:
        assert_same_columns(skein.evaluate(agent, episodes=8), expected)


def test_a_file_comes_on_top_of_what_a_run_flies(cessna_run, tmp_path):
    file = tmp_path / "longer.toml"
    file.write_text("[env]\ntime_limit_steps = 300\nhold_s = 2\n")
    settings = {"time_limit_steps": 300, "hold_s": 1}
    expected = skein.evaluate(cessna_run.policy, cessna_run.config, env=settings, episodes=8)
    for agent in (cessna_run.policy, f"policy:{cessna_run.path}"):
        flown = skein.evaluate(agent, file=file, env={"hold_s": 1}, episodes=8)
        assert_same_columns(flown, expected)
    assert (expected.columns["control_steps"] <= 300).all()
    other_task = tmp_path / "control.toml"
    other_task.write_text('env.task = "control"\n')
    with pytest.raises(skein.ConfigurationError, match="control.*heading"):
        skein.evaluate(cessna_run.policy, file=other_task, episodes=8)


def test_a_policy_file_brings_a_preset_of_its_aircraft(cessna_run):
    pytest.importorskip("pandas")
    file = cessna_run.path / "checkpoints" / "policy-final.skein"
    expected = skein.evaluate(skein.load_policy(file), "heading", preset="cessna172", episodes=8)
    for agent in (skein.load_policy(file), f"policy:{file}", f"policy:{file}@sampled"):
        assert skein.evaluate(agent, episodes=8).starts == expected.starts
    assert_same_columns(skein.evaluate(skein.load_policy(file), episodes=8), expected)
    flights = skein.record(f"policy:{file}", count=1)
    assert flights["true_airspeed_fps"].iloc[0] < 200
    with pytest.raises(skein.Error, match="made with env.aircraft = cessna172"):
        skein.evaluate(skein.load_policy(file), preset="default", episodes=8)
    f16 = skein.evaluate("zero", "heading", episodes=8).starts
    assert skein.evaluate(f"policy:{file}@other-aircraft", episodes=8).starts == f16
    assert skein.evaluate(f"policy:{cessna_run.path}@other-aircraft", episodes=8).starts == f16


def test_a_policy_of_another_task_does_not_fly(heading_policy):
    with pytest.raises(skein.Error, match="heading"):
        skein.evaluate(heading_policy, "control", episodes=4)
