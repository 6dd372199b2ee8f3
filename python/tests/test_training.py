# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from conftest import ROOT

import skein

TINY = {
    "network.hidden_size": 16,
    "network.gru_size": 16,
    "ppo.num_aircraft": 64,
    "ppo.rollout_steps": 16,
    "ppo.chunk_length": 8,
    "ppo.minibatches": 2,
    "run.total_steps": 3 * 64 * 16 * 5,
    "evaluation.final_episodes": 8,
    "evaluation.interval_iterations": 0,
}


def test_a_training_leaves_a_run_and_shows_every_iteration(tmp_path):
    pytest.importorskip("pandas")
    seen = []
    run = skein.train("heading", tmp_path / "run", callback=seen.append, **TINY)
    assert [row["iteration"] for row in seen] == run.metrics["iteration"].tolist() == [1, 2, 3]
    assert [list(row) for row in seen] == [run.metrics.columns.tolist()] * 3
    np.testing.assert_allclose([row["value_loss"] for row in seen], run.metrics["value_loss"])
    assert run.config["network.gru_size"] == 16
    assert run.evaluation["episodes"] == 8
    assert run.policy.task == "heading"
    assert len(run.timing) == 3


def test_a_training_that_is_told_to_prints_nothing_and_its_callback_may(tmp_path, capfd):
    def stop(row):
        print("iteration", row["iteration"], flush=True)
        return False

    run = skein.train("heading", tmp_path / "run", callback=stop, progress=False, **TINY)
    assert capfd.readouterr().out == "iteration 1\n"
    run.resume(progress=False)
    assert capfd.readouterr().out == ""
    assert "trained for" in (tmp_path / "run" / "log.txt").read_text()
    run.resume()  # trained to its end: evaluated again
    assert "success" in capfd.readouterr().out


def test_a_run_without_iterations_says_so(tmp_path):
    pytest.importorskip("pandas")
    (tmp_path / "config.toml").write_text(skein.configure("heading").to_toml())
    with pytest.raises(skein.Error, match=r"no metrics.csv in it yet") as raised:
        skein.Run(tmp_path).metrics
    assert "\n" not in str(raised.value)
    (tmp_path / "timing.csv").write_text("")
    with pytest.raises(skein.Error, match=r"no timing.csv in it yet"):
        skein.Run(tmp_path).timing


def test_a_callback_does_not_change_what_is_learnt_and_may_end_it(tmp_path):
    skein.train("heading", tmp_path / "whole", **TINY)
    whole = (tmp_path / "whole" / "metrics.csv").read_text().splitlines()
    for name, boolean in {"python": bool, "numpy": np.bool_}.items():
        run = skein.train("heading", tmp_path / name, callback=lambda row: boolean(row["iteration"] < 2), **TINY)
        assert (run.path / "metrics.csv").read_text().splitlines() == whole[:3], name
        assert run.evaluation is None


def test_what_a_callback_raises_comes_through_and_the_run_is_saved(tmp_path):
    def broken(row):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        skein.train("heading", tmp_path / "run", callback=broken, **TINY)
    assert skein.Run(tmp_path / "run").policy.task == "heading"


def test_a_run_without_a_directory_is_not_begun(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(skein.ConfigurationError, match="out must name the directory"):
        skein.train("heading", "", **TINY)
    assert not list(tmp_path.iterdir())


def test_damaged_records_of_a_run_are_named(tmp_path):
    pytest.importorskip("pandas")
    for name, content in {"config.toml": "", "evaluation.json": "{", "metrics.csv": 'a,b\n1,2\n"'}.items():
        (tmp_path / name).write_text(content)
    run = skein.Run(tmp_path)
    for name, read in {"evaluation.json": lambda: run.evaluation, "metrics.csv": lambda: run.metrics}.items():
        with pytest.raises(skein.Error, match=f"{name}: .*damaged") as raised:
            read()
        assert "\n" not in str(raised.value)


def test_a_directory_without_a_run_is_refused(tmp_path):
    with pytest.raises(skein.Error, match="no config.toml"):
        skein.Run(tmp_path)


def test_a_policy_of_a_task_file_brings_its_task(tmp_path):
    pytest.importorskip("pandas")
    file = tmp_path / "mine.toml"
    file.write_text((ROOT / "examples" / "tasks" / "terrain_height.toml").read_text())
    run = skein.train(file, tmp_path / "run", **TINY)
    assert run.policy.task == "terrain_height"
    said = skein.evaluate(run.policy, file, episodes=8)
    file.unlink()
    for policy in (run.policy, skein.load_policy(tmp_path / "run")):
        known = skein.evaluate(policy, episodes=8)
        for name, column in said.columns.items():
            np.testing.assert_array_equal(column, known.columns[name], err_msg=name)
    assert len(skein.record(run.policy, count=1)) == said.columns["control_steps"][0] + 1
    with pytest.raises(skein.ConfigurationError, match="record: task is needed"):
        skein.record("zero")
    with pytest.raises(ValueError, match="5000000 are the most: lower count"):
        skein.record(run.policy, count=100000)
