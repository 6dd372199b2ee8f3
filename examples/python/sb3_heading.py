#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Stable-Baselines3's PPO, or sb3-contrib's RecurrentPPO, on the preset "easy" of Heading. Needs pip install ".[sb3]".

  examples/python/sb3_heading.py [--recurrent] [--steps N] [--aircraft N] [--seed N] [--threads N] [--json FILE]
"""
import argparse
import json
import sys
import time

import numpy as np

try:
    import torch
    from sb3_contrib import RecurrentPPO
    from stable_baselines3 import PPO
    from stable_baselines3.common.callbacks import BaseCallback
    from stable_baselines3.common.vec_env import VecNormalize

    import skein.sb3
except ImportError as error:
    sys.exit(f'{sys.argv[0]}: {error}; install the package with what this example needs: pip install ".[sb3]"')


GAMMA = 0.95


class Curve(BaseCallback):
    """The share of the latest episodes that reached their targets, by policy steps and seconds."""

    def _on_training_start(self):
        self.rows, self.start = [], time.perf_counter()

    def _on_step(self):
        return True

    def _on_rollout_end(self):
        latest = self.model.ep_success_buffer
        self.rows.append({"policy_steps": self.num_timesteps,
                          "seconds": round(time.perf_counter() - self.start, 1),
                          "success_rate": float(np.mean(latest)) if latest else 0.0})
        print("{policy_steps:>9} policy steps  {seconds:>6} s  success {success_rate:.3f}".format(**self.rows[-1]),
              flush=True)


def make_model(options, envs):
    shared = {"n_steps": 32, "n_epochs": 8, "batch_size": 512, "gamma": GAMMA, "learning_rate": lambda left: 1e-3 * left,
              "policy_kwargs": {"log_std_init": -1.5}, "stats_window_size": 500, "device": "cpu", "seed": options.seed}
    if options.recurrent:
        # A critic that sees what is observed, not what the actor's memory makes of it.
        shared["policy_kwargs"] |= {"lstm_hidden_size": 64, "enable_critic_lstm": False}
        return RecurrentPPO("MlpLstmPolicy", envs, **shared)
    return PPO("MlpPolicy", envs, **shared)


def evaluate(model, episodes):
    """The share of fresh episodes that reach their target under the mean of the policy."""
    envs = skein.sb3.VecEnv(skein.make_vec("heading", episodes, preset="easy", evaluation=True))
    envs.seed(1)
    observation, state = envs.reset(), None
    begins = np.ones(episodes, bool)
    first_end = [None] * episodes
    while any(end is None for end in first_end):
        observation = model.get_vec_normalize_env().normalize_obs(observation)
        action, state = model.predict(observation, state, begins, deterministic=True)
        observation, _, begins, infos = envs.step(action)
        for i in np.flatnonzero(begins):
            first_end[i] = first_end[i] or infos[i]["termination"]
    return first_end.count("target_reached") / episodes


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--recurrent", action="store_true", help="RecurrentPPO of sb3-contrib")
    parser.add_argument("--steps", type=int, default=600_000, help="policy steps over all aircraft")
    parser.add_argument("--aircraft", type=int, default=256)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=0, help="of the simulator; 0: one for each CPU it may use")
    parser.add_argument("--episodes", type=int, default=500, help="of the evaluation at the end")
    parser.add_argument("--json", help="also write the learning curve and the evaluation here")
    options = parser.parse_args()
    if options.json:
        open(options.json, "a", encoding="utf-8").close()  # what cannot be written fails before the training
    torch.set_num_threads(1)  # networks of this size gain nothing from more
    envs = VecNormalize(
        skein.sb3.VecEnv(skein.make_vec("heading", options.aircraft, preset="easy", threads=options.threads)), gamma=GAMMA)
    model, curve = make_model(options, envs), Curve()
    model.learn(options.steps, callback=curve)
    success = evaluate(model, options.episodes)
    print(f"deterministic success over {options.episodes} fresh episodes: {success:.3f}")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"curve": curve.rows, "success_rate": success}, file, indent=2)


if __name__ == "__main__":
    try:
        main()
    except (skein.Error, OSError) as error:
        sys.exit(f"{sys.argv[0]}: {error}")
