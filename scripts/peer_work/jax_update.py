#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The update of update_work.py by JAX: all epochs and minibatches in one jitted function, in float32.

  scripts/peer_work/jax_update.py SPEC.json      (needs pip install jax)
"""
import os
import sys
import time

from serving import serve
from update_work import ACTIONS, Work

WORK = Work(sys.argv[1])
# XLA's threads are as many as the processors that it may use when it starts.
os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:WORK.threads])

import jax  # noqa: E402
import jax.numpy as jnp  # noqa: E402


def norm(parameters, x):
    centred = x - x.mean(-1, keepdims=True)
    scale = jax.lax.rsqrt((centred * centred).mean(-1, keepdims=True) + 1e-5)
    return centred * scale * parameters[0] + parameters[1]


def linear(parameters, name, x):
    return norm(parameters[name + ".norm"], x) @ parameters[name + ".weight"] + parameters[name + ".bias"]


def forward(parameters, observation, state, not_done):
    """[steps, batch, outputs] of observations [steps, batch, observations]."""
    x = jax.nn.relu(linear(parameters, "first", observation))
    x = jax.nn.relu(linear(parameters, "second", x))
    x = norm(parameters["gru.norm"], x) @ parameters["gru.input"] + parameters["gru.input_bias"]
    states = []
    for step in range(WORK.steps):
        hidden = state @ parameters["gru.hidden"] + parameters["gru.hidden_bias"]
        i_r, i_z, i_n = jnp.split(x[step], 3, -1)
        h_r, h_z, h_n = jnp.split(hidden, 3, -1)
        update = jax.nn.sigmoid(i_z + h_z)
        state = (1 - update) * jnp.tanh(i_n + jax.nn.sigmoid(i_r + h_r) * h_n) + update * state
        states.append(state)
        state = state * not_done[step][:, None]  # of the next step
    x = jax.nn.relu(linear(parameters, "third", jnp.stack(states)))
    x = jax.nn.relu(linear(parameters, "fourth", x))
    return linear(parameters, "head", x)


def loss_of(parameters, batch):
    mean = jnp.tanh(forward(parameters["actor"], batch["observation"], batch["actor_state"], batch["not_done"]))
    value = forward(parameters["critic"], batch["observation"], batch["critic_state"], batch["not_done"])[..., 0]
    log_std = parameters["actor"]["log_std"]
    deviation = (batch["action"] - mean) * jnp.exp(-log_std)
    log_prob = (-0.5 * deviation**2 - log_std - 0.5 * jnp.log(2 * jnp.pi)).sum(-1)
    ratio = jnp.exp(log_prob - batch["log_prob"])
    clipped = jnp.clip(ratio, 1 - WORK.clip, 1 + WORK.clip)
    policy = -jnp.minimum(ratio * batch["advantage"], clipped * batch["advantage"]).mean()
    entropy = (log_std + 0.5 * jnp.log(2 * jnp.pi * jnp.e)).sum()
    return policy - WORK.entropy * entropy + WORK.value * 0.5 * ((value - batch["target"])**2).mean()


def clipped(gradient):
    size = jnp.sqrt(sum((leaf**2).sum() for leaf in jax.tree.leaves(gradient)))
    scale = jnp.minimum(1, WORK.max_norm / (size + 1e-6))
    return jax.tree.map(lambda leaf: leaf * scale, gradient)


def adam_step(parameters, gradient, first, second, count):
    first = jax.tree.map(lambda m, g: 0.9 * m + 0.1 * g, first, gradient)
    second = jax.tree.map(lambda v, g: 0.999 * v + 0.001 * g * g, second, gradient)
    rate = WORK.learning_rate / (1 - 0.9**count)
    correction = 1 - 0.999**count
    parameters = jax.tree.map(
        lambda p, m, v: p - rate * m / (jnp.sqrt(v / correction) + WORK.epsilon), parameters, first, second)
    return parameters, first, second


@jax.jit
def update(parameters, rollout, orders):
    """All minibatches; the parameters after them, and the loss of the first one."""
    def minibatch(carry, order):
        parameters, first, second, count = carry
        batch = {name: array[order] if name.endswith("state") else jnp.moveaxis(array[order], 0, 1)
                 for name, array in rollout.items()}
        loss, gradient = jax.value_and_grad(loss_of)(parameters, batch)
        gradient = {network: clipped(own) for network, own in gradient.items()}
        parameters, first, second = adam_step(parameters, gradient, first, second, count)
        return (parameters, first, second, count + 1), loss

    zeros = jax.tree.map(jnp.zeros_like, parameters)
    carry, losses = jax.lax.scan(minibatch, (parameters, zeros, zeros, 1.0), orders)
    return carry[0], losses


def main():
    parameters = {"actor": WORK.parameters(ACTIONS, 1), "critic": WORK.parameters(1, 2)}
    parameters, rollout, orders = jax.device_put((parameters, WORK.rollout(), WORK.orders()))

    def run():
        start = time.perf_counter()
        _, losses = jax.block_until_ready(update(parameters, rollout, orders))
        return time.perf_counter() - start, losses

    losses = run()[1]  # compiles
    serve({"version": jax.__version__, "name": "JAX, one jitted update", "samples": WORK.samples,
           "flops_per_sample": WORK.flops_per_sample(), "first_loss": float(losses[0]), "last_loss": float(losses[-1])},
          lambda: {"samples_per_s": WORK.samples / run()[0]})


if __name__ == "__main__":
    main()
