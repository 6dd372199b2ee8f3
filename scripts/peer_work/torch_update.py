#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The update of update_work.py by PyTorch, in float32: as Python calls it, or through torch.compile (PyTorch 2).

  scripts/peer_work/torch_update.py SPEC.json eager|compile      (needs pip install torch, or Debian's python3-torch)
"""
import math
import sys
import time

import torch
from torch.nn import functional

from serving import serve
from update_work import ACTIONS, Work

WORK = Work(sys.argv[1])
HOW = sys.argv[2]


def normed(parameters, name, x):
    weight, bias = parameters[name + ".norm"]
    return functional.layer_norm(x, x.shape[-1:], weight, bias)


def linear(parameters, name, x):
    return normed(parameters, name, x) @ parameters[name + ".weight"] + parameters[name + ".bias"]


def forward(parameters, observation, state, not_done):
    """[steps, batch, outputs] of observations [steps, batch, observations]."""
    x = torch.relu(linear(parameters, "first", observation))
    x = torch.relu(linear(parameters, "second", x))
    x = normed(parameters, "gru", x) @ parameters["gru.input"] + parameters["gru.input_bias"]
    states = []
    for step in range(WORK.steps):
        hidden = torch.addmm(parameters["gru.hidden_bias"], state, parameters["gru.hidden"])
        i_r, i_z, i_n = x[step].chunk(3, -1)
        h_r, h_z, h_n = hidden.chunk(3, -1)
        update = torch.sigmoid(i_z + h_z)
        state = (1 - update) * torch.tanh(i_n + torch.sigmoid(i_r + h_r) * h_n) + update * state
        states.append(state)
        state = state * not_done[step][:, None]  # of the next step
    x = torch.relu(linear(parameters, "third", torch.stack(states)))
    x = torch.relu(linear(parameters, "fourth", x))
    return linear(parameters, "head", x)


def loss_of(actor, critic, batch):
    mean = torch.tanh(forward(actor, batch["observation"], batch["actor_state"], batch["not_done"]))
    value = forward(critic, batch["observation"], batch["critic_state"], batch["not_done"])[..., 0]
    log_std = actor["log_std"]
    deviation = (batch["action"] - mean) * torch.exp(-log_std)
    log_prob = (-0.5 * deviation**2 - log_std - 0.5 * math.log(2 * math.pi)).sum(-1)
    ratio = torch.exp(log_prob - batch["log_prob"])
    clipped = ratio.clamp(1 - WORK.clip, 1 + WORK.clip)
    policy = -torch.minimum(ratio * batch["advantage"], clipped * batch["advantage"]).mean()
    entropy = (log_std + 0.5 * math.log(2 * math.pi * math.e)).sum()
    return policy - WORK.entropy * entropy + WORK.value * 0.5 * ((value - batch["target"])**2).mean()


def as_parameters(arrays):
    return {name: torch.from_numpy(array).clone().requires_grad_() for name, array in arrays.items()}


def update(loss_function, rollout, orders):
    """All minibatches from the same parameters on; the losses of the first and of the last."""
    networks = [as_parameters(WORK.parameters(ACTIONS, 1)), as_parameters(WORK.parameters(1, 2))]
    optimiser = torch.optim.Adam([value for network in networks for value in network.values()],
                                 lr=WORK.learning_rate, eps=WORK.epsilon)
    losses = []
    for order in orders:
        batch = {name: array[order] if name.endswith("state") else array[order].transpose(0, 1).contiguous()
                 for name, array in rollout.items()}
        optimiser.zero_grad()
        loss = loss_function(*networks, batch)
        loss.backward()
        for network in networks:
            torch.nn.utils.clip_grad_norm_(network.values(), WORK.max_norm)
        optimiser.step()
        losses.append(loss.detach())
    return float(losses[0]), float(losses[-1])


def main():
    torch.set_num_threads(WORK.threads)
    loss_function = torch.compile(loss_of) if HOW == "compile" else loss_of
    rollout = {name: torch.from_numpy(array) for name, array in WORK.rollout().items()}
    orders = torch.from_numpy(WORK.orders())

    def run():
        start = time.perf_counter()
        losses = update(loss_function, rollout, orders)
        return time.perf_counter() - start, losses

    first_loss, last_loss = run()[1]  # compiles
    serve({"version": torch.__version__, "name": f"PyTorch, {HOW}", "samples": WORK.samples,
           "flops_per_sample": WORK.flops_per_sample(), "first_loss": first_loss, "last_loss": last_loss},
          lambda: {"samples_per_s": WORK.samples / run()[0]})


if __name__ == "__main__":
    main()
