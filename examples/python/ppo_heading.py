#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Proximal policy optimisation in one file, in the manner of CleanRL: PyTorch on the CPU, no other library for learning.
Flies the preset "easy" of Heading. Needs pip install ".[torch]".

  examples/python/ppo_heading.py [--steps N] [--aircraft N] [--seed N] [--threads N] [--json FILE]
"""
import argparse
import json
import sys
import time

import numpy as np

try:
    import torch
    from torch import nn

    import skein
except ImportError as error:
    sys.exit(f'{sys.argv[0]}: {error}; install the package with what this example needs: pip install ".[torch]"')


def layer(inputs, outputs, gain=2**0.5):
    linear = nn.Linear(inputs, outputs)
    nn.init.orthogonal_(linear.weight, gain)
    nn.init.zeros_(linear.bias)
    return linear


def network(inputs, outputs, last_gain):
    return nn.Sequential(layer(inputs, 64), nn.Tanh(), layer(64, 64), nn.Tanh(), layer(64, outputs, last_gain))


class Scale(nn.Module):
    """Mean and variance of all that was seen, by which numbers come to unit size."""

    def __init__(self, size):
        super().__init__()
        self.register_buffer("count", torch.tensor(1e-4))
        self.register_buffer("mean", torch.zeros(size))
        self.register_buffer("variance", torch.ones(size))

    def see(self, rows):
        weight = len(rows) / (self.count + len(rows))
        change = rows.mean(0) - self.mean
        self.variance += weight * (rows.var(0, correction=0) - self.variance) + weight * (1 - weight) * change**2
        self.mean += weight * change
        self.count += len(rows)

    def forward(self, rows):
        return ((rows - self.mean) / (self.variance + 1e-8).sqrt()).clamp(-10, 10)


class Agent(nn.Module):
    def __init__(self, envs, initial_log_std):
        super().__init__()
        observed, acted = envs.single_observation_space.shape[0], envs.single_action_space.shape[0]
        self.observation_scale, self.return_scale = Scale(observed), Scale(1)
        self.critic = network(observed, 1, 1.0)
        self.actor = network(observed, acted, 0.01)
        self.log_std = nn.Parameter(torch.full((acted,), initial_log_std))

    def mean(self, observation):
        return self.actor(self.observation_scale(observation))

    def distribution(self, observation):
        return torch.distributions.Normal(self.mean(observation), self.log_std.exp())

    def value(self, observation):
        return self.critic(self.observation_scale(observation)).squeeze(-1)


class Rollout:
    """Policy steps of all aircraft, [step][aircraft]."""

    def __init__(self, steps, envs):
        n = envs.num_envs
        self.observation = torch.zeros(steps, n, *envs.single_observation_space.shape)
        self.action = torch.zeros(steps, n, *envs.single_action_space.shape)
        self.log_prob, self.value, self.reward, self.done = (torch.zeros(steps, n) for _ in range(4))
        self.discounted = torch.zeros(n)

    def fill(self, agent, envs, observation, gamma):
        """Flies on from `observation`; returns the next one and the terminations of episodes that ended."""
        ended = []
        for step in range(len(self.reward)):
            with torch.no_grad():
                seen = torch.from_numpy(observation)
                distribution = agent.distribution(seen)
                action = distribution.sample()
                self.observation[step], self.action[step] = seen, action
                self.log_prob[step] = distribution.log_prob(action).sum(-1)
                self.value[step] = agent.value(seen)
            observation, reward, terminated, truncated, info = envs.step(action)
            reward = self.scaled(agent, reward, terminated | truncated, gamma)
            if truncated.any():  # what would have come after the limit
                last = np.stack(info["final_obs"][truncated])
                with torch.no_grad():
                    reward[truncated] += gamma * agent.value(torch.from_numpy(last)).numpy()
            self.reward[step] = torch.from_numpy(reward)
            self.done[step] = torch.from_numpy(terminated | truncated).float()
            if "final_info" in info:
                ended += info["final_info"]["termination"][info["_final_info"]].tolist()
        return observation, ended

    def scaled(self, agent, reward, over, gamma):
        """Rewards in units of the deviation of their discounted sums."""
        self.discounted = gamma * self.discounted + torch.from_numpy(reward)
        agent.return_scale.see(self.discounted[:, None])
        self.discounted[torch.from_numpy(over)] = 0
        return reward / np.sqrt(agent.return_scale.variance.item() + 1e-8)

    def advantages(self, next_value, gamma, gae_lambda):
        advantage = torch.zeros_like(self.reward)
        following = torch.zeros_like(next_value)
        for step in reversed(range(len(self.reward))):
            goes_on = 1 - self.done[step]
            delta = self.reward[step] + gamma * next_value * goes_on - self.value[step]
            following = delta + gamma * gae_lambda * goes_on * following
            advantage[step], next_value = following, self.value[step]
        return advantage


def update(agent, optimiser, rollout, advantage, options):
    flat = [tensor.flatten(0, 1) for tensor in (rollout.observation, rollout.action, rollout.log_prob, advantage)]
    observation, action, log_prob, advantage = flat
    returns = advantage + rollout.value.flatten()
    for _ in range(options.epochs):
        for rows in torch.randperm(len(returns)).chunk(options.minibatches):
            distribution = agent.distribution(observation[rows])
            ratio = (distribution.log_prob(action[rows]).sum(-1) - log_prob[rows]).exp()
            gain = (advantage[rows] - advantage[rows].mean()) / (advantage[rows].std() + 1e-8)
            policy_loss = -torch.min(ratio * gain, ratio.clamp(1 - options.clip, 1 + options.clip) * gain).mean()
            value_loss = (agent.value(observation[rows]) - returns[rows]).square().mean()
            optimiser.zero_grad()
            (policy_loss + 0.5 * value_loss).backward()
            nn.utils.clip_grad_norm_(agent.parameters(), 0.5)
            optimiser.step()


def train(options):
    torch.manual_seed(options.seed)
    torch.set_num_threads(1)  # networks of this size gain nothing from more
    envs = skein.make_vec("heading", options.aircraft, preset="easy", threads=options.threads)
    agent = Agent(envs, options.initial_log_std)
    optimiser = torch.optim.Adam(agent.parameters(), lr=options.learning_rate, eps=1e-5)
    rollout = Rollout(options.rollout_steps, envs)
    observation, _ = envs.reset(seed=options.seed)
    iterations = max(options.steps // rollout.reward.numel(), 1)
    curve, start = [], time.perf_counter()
    for iteration in range(iterations):
        optimiser.param_groups[0]["lr"] = options.learning_rate * (1 - iteration / iterations)
        observation, ended = rollout.fill(agent, envs, observation, options.gamma)
        with torch.no_grad():
            next_value = agent.value(torch.from_numpy(observation))
        advantage = rollout.advantages(next_value, options.gamma, options.gae_lambda)
        update(agent, optimiser, rollout, advantage, options)
        agent.observation_scale.see(rollout.observation.flatten(0, 1))
        curve.append({"policy_steps": (iteration + 1) * rollout.reward.numel(),
                      "seconds": round(time.perf_counter() - start, 1),
                      "success_rate": ended.count("target_reached") / max(len(ended), 1),
                      "reward_mean": rollout.reward.mean().item()})
        print("{policy_steps:>9} policy steps  {seconds:>6} s  success {success_rate:.3f}  "
              "reward {reward_mean:.3f}".format(**curve[-1]), flush=True)
    return agent, curve


def evaluate(agent, episodes):
    """The share of fresh episodes that reach their target under the mean of the policy."""
    def fly(observations):
        with torch.no_grad():
            return agent.mean(torch.from_numpy(observations)).numpy()

    return skein.evaluate(fly, "heading", preset="easy", episodes=episodes, seed=1).success_rate


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=600_000, help="policy steps over all aircraft")
    parser.add_argument("--aircraft", type=int, default=256)
    parser.add_argument("--rollout-steps", type=int, default=32)
    parser.add_argument("--epochs", type=int, default=8)
    parser.add_argument("--minibatches", type=int, default=16)
    parser.add_argument("--learning-rate", type=float, default=1e-3)
    parser.add_argument("--initial-log-std", type=float, default=-1.5, help="of the actions")
    parser.add_argument("--gamma", type=float, default=0.95)
    parser.add_argument("--gae-lambda", type=float, default=0.95)
    parser.add_argument("--clip", type=float, default=0.2)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=0, help="of the simulator; 0: one for each CPU it may use")
    parser.add_argument("--episodes", type=int, default=500, help="of the evaluation at the end")
    parser.add_argument("--json", help="also write the learning curve and the evaluation here")
    options = parser.parse_args()
    if options.json:
        open(options.json, "a", encoding="utf-8").close()  # what cannot be written fails before the training
    agent, curve = train(options)
    success = evaluate(agent, options.episodes)
    print(f"deterministic success over {options.episodes} fresh episodes: {success:.3f}")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"curve": curve, "success_rate": success}, file, indent=2)


if __name__ == "__main__":
    try:
        main()
    except (skein.Error, OSError) as error:
        sys.exit(f"{sys.argv[0]}: {error}")
