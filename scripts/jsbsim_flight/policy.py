# SPDX-License-Identifier: Apache-2.0
"""A policy of scripts/act whose matrix products are numpy's, so that many flights take seconds."""
import importlib.machinery
import importlib.util
import os

import numpy

_path = os.path.join(os.path.dirname(os.path.dirname(os.path.realpath(__file__))), "act")
_loader = importlib.machinery.SourceFileLoader("act", _path)
act = importlib.util.module_from_spec(importlib.util.spec_from_loader("act", _loader))
_loader.exec_module(act)


class Policy(act.Policy):
    """Flies one aircraft at a time: begin() before each flight, then act(observation) at every policy step."""

    def __init__(self, path):
        super().__init__(path)
        self.matrices = {name: numpy.array(values).reshape(shape) for name, (shape, values) in self.arrays.items()}
        self.action_repeat = int(self.metadata["policy.action_repeat"])

    def begin(self):
        self.state = [0.0] * len(self.state)

    def affine(self, name, x):
        return (self.matrices[name + ".weight"] @ x + self.matrices[name + ".bias"]).tolist()
