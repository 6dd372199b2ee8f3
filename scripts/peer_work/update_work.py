# SPDX-License-Identifier: Apache-2.0
"""The update of recurrent PPO that scripts/peers has several libraries compute: sizes, parameters, rollout and order of
minibatches, the same numbers for all of them.

The networks are Skein's (train/network/network_config.h): LayerNorm of the observation; twice Linear, ReLU, LayerNorm;
a GRU; LayerNorm; the same twice again; a linear head. Chunks of a rollout are time-major, their states are reset where
an episode ended. The loss is PPO's clipped surrogate, an entropy bonus, and half the squared error of the value; norms of
gradients are clipped for actor and critic separately, and Adam takes the step.
"""
import json

import numpy as np

OBSERVATIONS, ACTIONS = 22, 4  # of task Heading, without what a privileged critic sees


class Work:
    """What a file of scripts/peers says, and the arrays that follow from it."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            spec = json.load(file)
        self.hidden, self.gru = spec["hidden_size"], spec["gru_size"]
        self.steps, self.epochs, self.minibatches = spec["chunk_length"], spec["epochs"], spec["minibatches"]
        self.chunks = spec["num_aircraft"] * spec["rollout_steps"] // self.steps
        self.clip, self.max_norm = spec["clip"], spec["max_gradient_norm"]
        self.entropy, self.value = spec["entropy_coefficient"], spec["value_coefficient"]
        self.learning_rate, self.epsilon = spec["learning_rate"], spec["adam_epsilon"]
        self.threads = spec["threads"]

    @property
    def samples(self):
        """That an update learns from, each epoch's anew."""
        return self.chunks * self.steps * self.epochs

    def shapes(self, outputs):
        """Name and shape of a network's parameters; matrices are [in, out], gates in the order r, z, n, norms hold
        weight and bias."""
        h, g = self.hidden, self.gru

        def normed_linear(name, size, out):
            return [(name + ".norm", (2, size)), (name + ".weight", (size, out)), (name + ".bias", (out,))]

        gru = [("gru.norm", (2, h)), ("gru.input", (h, 3 * g)), ("gru.input_bias", (3 * g,)),
               ("gru.hidden", (g, 3 * g)), ("gru.hidden_bias", (3 * g,))]
        return (normed_linear("first", OBSERVATIONS, h) + normed_linear("second", h, h) + gru
                + normed_linear("third", g, h) + normed_linear("fourth", h, h) + normed_linear("head", h, outputs))

    def parameters(self, outputs, seed):
        random = np.random.default_rng(seed)
        values = {}
        for name, shape in self.shapes(outputs):
            if name.endswith("norm"):
                values[name] = np.stack([np.ones(shape[1]), np.zeros(shape[1])])
            elif len(shape) == 2:
                values[name] = random.standard_normal(shape) / np.sqrt(shape[0])
            else:
                values[name] = np.zeros(shape)
        if outputs == ACTIONS:
            values["log_std"] = np.zeros(ACTIONS)
        return {name: value.astype(np.float32) for name, value in values.items()}

    def flops_per_sample(self):
        """Multiplications and additions of matrix products: one product forward, two backward, without those for
        gradients with respect to observations and to the states that chunks begin with, which none needs that folds
        norms into the matrices (train/network/network.h)."""
        weights = sum(int(np.prod(shape)) for outputs in (ACTIONS, 1) for name, shape in self.shapes(outputs)
                      if len(shape) == 2 and not name.endswith("norm"))
        to_observation, to_first_state = OBSERVATIONS * self.hidden, 3 * self.gru * self.gru / self.steps
        return 2 * (3 * weights - 2 * (to_observation + to_first_state))  # of two networks

    def rollout(self):
        """Arrays [chunks, steps, ...] and the states that chunks begin with."""
        random = np.random.default_rng(0)
        lead = (self.chunks, self.steps)

        def normal(*shape):
            return random.standard_normal(shape, dtype=np.float32)

        return {"observation": normal(*lead, OBSERVATIONS), "action": 0.5 * normal(*lead, ACTIONS),
                "log_prob": -4 + 0.1 * normal(*lead), "advantage": normal(*lead), "target": normal(*lead),
                "not_done": (random.random(lead) > 0.02).astype(np.float32),
                "actor_state": 0.1 * normal(self.chunks, self.gru), "critic_state": 0.1 * normal(self.chunks, self.gru)}

    def orders(self):
        """[epochs x minibatches, chunks of a minibatch]: numbers of chunks."""
        random = np.random.default_rng(1)
        size = self.chunks // self.minibatches
        return np.concatenate([random.permutation(self.chunks)[: size * self.minibatches].reshape(-1, size)
                               for _ in range(self.epochs)])
