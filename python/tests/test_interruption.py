# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C, threads and processes."""
import multiprocessing
import os
import re
import select
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import skein

MOST_SECONDS = 5  # asked for is one; the machine may be busy

LONG = """
import os, signal, sys, threading, time
import skein
signal.signal(signal.SIGINT, signal.default_int_handler)  # also where it was ignored, as in the background
def interrupt():
    time.sleep({delay})
    print(time.monotonic(), flush=True)
    os.kill(os.getpid(), signal.SIGINT)
try:
    threading.Thread(target=interrupt).start()
    {call}
    print("went on")
except KeyboardInterrupt:
    print(time.monotonic(), "interrupted")
handler = signal.getsignal(signal.SIGINT)
assert handler is signal.default_int_handler
try:
    os.kill(os.getpid(), signal.SIGINT)
    time.sleep(10)
except KeyboardInterrupt:
    print("again")
"""


@pytest.mark.parametrize(
    "call",
    [
        'skein.train("heading", "run")',
        'skein.train("heading", "run", callback=lambda row: None)',
        'skein.evaluate("autopilot", "heading", episodes=10**5)',
        'skein.compare(["autopilot", "zero"], "heading", episodes=10**5)',
    ],
)
@pytest.mark.parametrize("delay", [0.05, 1])
def test_ctrl_c_is_a_keyboard_interrupt(call, delay, tmp_path):
    command = [sys.executable, "-c", LONG.format(call=call, delay=delay)]
    lines = subprocess.run(command, capture_output=True, text=True, check=True, cwd=tmp_path, timeout=120).stdout.splitlines()
    # A fast machine has shown progress by then, which begins with a number, too.
    times = [line.split() for line in lines if re.fullmatch(r"[0-9.]+( interrupted)?", line)]
    assert lines[-1] == "again", lines
    assert times[1][1] == "interrupted", lines
    assert float(times[1][0]) - float(times[0][0]) < MOST_SECONDS


TWICE = """
import os, signal, threading, time
import numpy as np
import skein
signal.signal(signal.SIGINT, signal.default_int_handler)
def interrupt():
    for _ in range(2):
        time.sleep(1)
        os.kill(os.getpid(), signal.SIGINT)
def slow(given):
    time.sleep(100)
    return np.zeros((len(given), 4), np.float32)
threading.Thread(target=interrupt).start()
try:
    {call}
except KeyboardInterrupt:
    print("interrupted")
finally:
    print("cleared up")
"""


@pytest.mark.parametrize(
    "call",
    [
        'skein.train("heading", "run", callback=slow, progress=False)',
        'skein.evaluate(slow, "heading", episodes=2, threads=1)',
    ],
)
def test_a_second_ctrl_c_interrupts_what_python_runs(call, tmp_path):
    settings = 'preset="quick", **{"run.total_steps": 10**6}' if "train" in call else ""
    command = [sys.executable, "-c", TWICE.format(call=call.replace(")", f", {settings})") if settings else call)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, timeout=90)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "interrupted\ncleared up\n"


AT_EXIT = """
import threading, time
import numpy as np
import skein
env = skein.make("heading")
env.reset(seed=1)
envs = skein.make_vec("heading", 64)
envs.reset(seed=1)
still = np.zeros((64, 4), np.float32)
def zeros(seen):
    return np.zeros((len(seen), 4), np.float32)
def work():
    while True:
        {call}
threading.Thread(target=work, daemon=True).start()
time.sleep(0.5)
"""


@pytest.mark.parametrize(
    "call",
    [
        "env.step([0, 0, 0, 0])[2] and env.reset()",
        "envs.step(still)",
        "skein.trim_grid([15000], [500])",
        'skein.evaluate(zeros, "heading", episodes=1, threads=1)',
    ],
)
def test_a_daemon_thread_does_not_disturb_the_end_of_the_program(call):
    done = subprocess.run([sys.executable, "-c", AT_EXIT.format(call=call)], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, "")


TINY = {
    "network.hidden_size": 16, "network.gru_size": 16, "ppo.num_aircraft": 64, "ppo.rollout_steps": 16,
    "ppo.chunk_length": 8, "ppo.minibatches": 2, "run.total_steps": 6 * 64 * 16 * 5, "evaluation.final_episodes": 8,
    "evaluation.interval_iterations": 0,
}


@pytest.fixture
def sigint_as_python_has_it():
    """Which it is not in what a shell runs in the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_an_interrupted_training_is_resumed_to_the_same_bits(tmp_path, sigint_as_python_has_it):
    def interrupted(row):
        if row["iteration"] == 2:
            os.kill(os.getpid(), signal.SIGINT)

    whole = skein.train("heading", tmp_path / "whole", **TINY)
    with pytest.raises(KeyboardInterrupt):
        skein.train("heading", tmp_path / "cut", callback=interrupted, **TINY)
    cut = skein.Run(tmp_path / "cut")
    assert cut.evaluation is None
    seen = []
    assert cut.resume(callback=seen.append).evaluation is not None
    assert [row["iteration"] for row in seen] == [3, 4, 5, 6]
    for name in ("metrics.csv", "checkpoints/policy-final.skein"):
        assert (cut.path / name).read_bytes() == (whole.path / name).read_bytes()


def handled_in(work, number):
    """What a handler that raises nothing sees of a signal that comes in the midst of the work."""
    seen = []
    before = signal.signal(number, lambda number, frame: seen.append(number))
    timer = threading.Timer(1, os.kill, (os.getpid(), number))
    try:
        timer.start()
        work()
        assert not timer.is_alive(), "the work was over before the signal"
    finally:
        timer.join()
        signal.signal(number, before)
    return seen


@pytest.mark.parametrize(
    "work",
    [
        lambda: skein.evaluate("autopilot", "heading", episodes=10**5, threads=1),
        lambda: skein.compare(["autopilot", "zero"], "heading", episodes=10**5, threads=1),
        lambda: skein.record("autopilot", "heading", count=1000, threads=1),
    ],
)
def test_what_a_handler_lets_be_stopped_is_no_result(work):
    def stopped():
        with pytest.raises(skein.Error, match="^stopped by a signal, .*: there is no result$"):
            work()

    assert handled_in(stopped, signal.SIGINT) == [signal.SIGINT]


def test_a_training_that_a_handler_lets_be_stopped_is_a_run_that_can_go_on(tmp_path):
    seen = []
    before = signal.signal(signal.SIGTERM, lambda number, frame: seen.append(number))
    try:
        run = skein.train("heading", tmp_path / "run", callback=lambda row: os.kill(os.getpid(), signal.SIGTERM), **TINY)
    finally:
        signal.signal(signal.SIGTERM, before)
    assert seen == [signal.SIGTERM]
    assert run.evaluation is None
    assert run.resume().evaluation is not None


def test_sigusr1_is_left_to_pythons_handler():
    results = []

    def evaluate():
        results.append(skein.evaluate("autopilot", "heading", episodes=20000, threads=1))

    assert handled_in(evaluate, signal.SIGUSR1) == [signal.SIGUSR1]
    assert results[0].success_rate > 0.99


def counted_while(work):
    """How often another thread of Python came to run during the work, by hundredths of a second."""
    counts, ended = [0], threading.Event()

    def count():
        while not ended.wait(0.01):
            counts[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    start = time.monotonic()
    work()
    seconds = time.monotonic() - start
    ended.set()
    thread.join()
    return counts[0] / (seconds * 100)


def test_other_threads_of_python_run_on_during_long_work():
    envs = skein.make_vec("heading", 4096, threads=1, **{"env.action_repeat": 100})
    envs.reset(seed=0)
    actions = np.zeros((4096, 4), np.float32)
    assert counted_while(lambda: envs.step(actions)) > 0.2
    assert counted_while(lambda: skein.evaluate("autopilot", "heading", episodes=500, threads=1)) > 0.2


def rollout(seed, num_envs=64, threads=0):
    envs = skein.make_vec("heading", num_envs, threads=threads)
    shown = [envs.reset(seed=seed)[0]]
    draw = np.random.default_rng(seed)
    for _ in range(30):
        shown.append(envs.step(draw.uniform(-1, 1, (num_envs, 4)).astype(np.float32))[0])
    return np.stack(shown)


def test_environments_of_many_threads_do_not_meet():
    alone = [rollout(seed) for seed in range(6)]
    together = [None] * 6

    def fly(seed):
        together[seed] = rollout(seed)

    threads = [threading.Thread(target=fly, args=(seed,)) for seed in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for first, second in zip(alone, together, strict=True):
        np.testing.assert_array_equal(first, second)


def test_evaluations_of_many_threads_do_not_meet():
    rates = [None] * 3

    def fly(seed):
        rates[seed] = skein.evaluate("autopilot", "heading", episodes=48, seed=seed).return_mean

    threads = [threading.Thread(target=fly, args=(seed,)) for seed in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert rates == [skein.evaluate("autopilot", "heading", episodes=48, seed=seed).return_mean for seed in range(3)]


@pytest.mark.parametrize("method", ["spawn", "forkserver", "fork"])
@pytest.mark.parametrize("num_envs", [1, 64])
def test_environments_of_processes(method, num_envs):
    here = rollout(1, num_envs, threads=2)  # threads are there before the fork
    with multiprocessing.get_context(method).Pool(2) as pool:
        for there in pool.starmap_async(rollout, [(1, num_envs, 2), (1, num_envs, 1)]).get(timeout=120):
            np.testing.assert_array_equal(here, there)


def uses_in_child(use):
    """What a forked child says of `use`: its error's text, or "went on"."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            use()
            os.write(writer, b"went on")
        except skein.Error as error:
            os.write(writer, str(error).encode())
        finally:
            os._exit(0)
    os.close(writer)
    answered = select.select([reader], [], [], MOST_SECONDS)[0]
    if not answered:
        os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    with os.fdopen(reader) as said:
        return said.read()


@pytest.mark.parametrize("num_envs", [1, 256])
def test_a_forked_process_is_refused_environments_of_its_parent(num_envs):
    envs = skein.make_vec("heading", num_envs, threads=2)
    envs.reset(seed=1)
    actions = np.zeros((num_envs, 4), np.float32)
    done = threading.Event()

    def fly():
        while not done.is_set():
            envs.step(actions)

    thread = threading.Thread(target=fly)
    thread.start()  # in whose step the fork comes: nobody ends it there
    try:
        for use in (lambda: envs.step(actions), envs.reset, envs.state, envs.targets, envs.snapshot):
            said = uses_in_child(use)
            assert "was forked" in said and "\n" not in said
    finally:
        done.set()
        thread.join()
    envs.step(actions)


def test_a_forked_process_is_refused_a_single_environment_of_its_parent():
    env = skein.make("heading")
    env.reset(seed=1)
    snapshot = env.snapshot()
    for use in (lambda: env.step(np.zeros(4)), env.reset, lambda: env.restore(snapshot)):
        assert "was forked" in uses_in_child(use)
    env.close()
    env = skein.make("heading")
    assert uses_in_child(env.close) == "went on"
