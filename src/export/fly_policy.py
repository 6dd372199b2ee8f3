#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Flies an exported policy by the libraries of its format: reads policy steps, float32 rows of [1 where an episode
begins, observations], from the standard input, and writes rows of actions.

    python3 fly_policy.py onnx|safetensors|torchscript FILE <rows >actions"""
import sys


def onnx_policy(path):
    import numpy
    import onnx
    import onnxruntime

    onnx.checker.check_model(path, full_check=True)  # infers and compares shapes, too
    session = onnxruntime.InferenceSession(path, providers=["CPUExecutionProvider"])
    sizes = {value.name: value.shape[1] for value in session.get_inputs()}

    def act(observation, state):
        actions, state = session.run(["actions", "h_out"], {"obs": observation, "h_in": state})
        return actions, state

    return act, sizes["obs"], numpy.zeros((1, sizes["h_in"]), numpy.float32)


def safetensors_policy(path):
    import numpy
    from safetensors import safe_open

    with safe_open(path, "numpy") as file:
        metadata = file.metadata()
        arrays = {name: file.get_tensor(name) for name in file.keys()}
    hidden, layers, size = (int(metadata[key]) for key in ("hidden_layers", "gru_layers", "gru_size"))
    activate = {
        "relu": lambda x: numpy.maximum(x, 0),
        "tanh": numpy.tanh,
        "elu": lambda x: numpy.where(x > 0, x, numpy.expm1(x)),
        "silu": lambda x: x * sigmoid(x),
    }[metadata["activation"]]

    def sigmoid(x):
        return 1 / (1 + numpy.exp(-x))

    def norm(name, x):
        x = x - x.mean(1, keepdims=True)
        x = x / numpy.sqrt((x * x).mean(1, keepdims=True) + numpy.float32(1e-5))
        return x * arrays[name + ".weight"] + arrays[name + ".bias"]

    def linear(name, x):
        return norm(name + ".norm", x) @ arrays[name + ".linear.weight"].T + arrays[name + ".linear.bias"]

    def product(kind, layer, x):
        return x @ arrays[f"gru.weight_{kind}_l{layer}"].T + arrays[f"gru.bias_{kind}_l{layer}"]

    def act(observation, state):
        x, states = observation, []
        for number in range(1, hidden + 1):
            x = activate(linear(f"layer{number}", x))
        x = norm("gru_norm", x)
        for layer, before in enumerate(numpy.split(state, layers, 1)):
            i_r, i_z, i_n = numpy.split(product("ih", layer, x), 3, 1)
            s_r, s_z, s_n = numpy.split(product("hh", layer, before), 3, 1)
            update = sigmoid(i_z + s_z)
            x = (1 - update) * numpy.tanh(i_n + sigmoid(i_r + s_r) * s_n) + update * before
            states.append(x)
        for number in range(hidden + 1, 2 * hidden + 1):
            x = activate(linear(f"layer{number}", x))
        x = linear("head", x)
        x = numpy.tanh(x) if metadata["tanh_mean"] == "true" else x
        return numpy.clip(x, -1, 1), numpy.concatenate(states, 1)

    first = "layer1.norm.weight" if hidden > 0 else "gru_norm.weight"
    return act, len(arrays[first]), numpy.zeros((1, layers * size), numpy.float32)


def torchscript_policy(path):
    import numpy
    import torch

    files = {"metadata.json": ""}
    module = torch.jit.load(path, _extra_files=files)
    shapes = {name: parameter.shape for name, parameter in module.named_parameters()}
    layers = sum(name.startswith("gru_weight_hh") for name in shapes)
    first = "layer1_norm_weight" if "layer1_norm_weight" in shapes else "gru_norm_weight"

    def act(observation, state):
        with torch.no_grad():
            actions, state = module(torch.from_numpy(observation), torch.from_numpy(state))
        return actions.numpy(), state.numpy()

    return act, shapes[first][0], numpy.zeros((1, layers * shapes["gru_weight_hh_l0"][1]), numpy.float32)


PACKAGES = {"onnx": "numpy onnx onnxruntime", "safetensors": "numpy safetensors", "torchscript": "numpy torch"}


def main():
    form, path = sys.argv[1:]
    try:
        act, size, zeros = globals()[form + "_policy"](path)
        import numpy
    except ImportError as error:
        sys.exit(f"{sys.executable} has no package {error.name}: {sys.executable} -m pip install {PACKAGES[form]}, "
                 "or name a Python that has them by the environment variable SKEIN_PYTHON")
    rows = numpy.frombuffer(sys.stdin.buffer.read(), numpy.float32).reshape(-1, 1 + size)
    state = zeros
    for row in rows:
        state = zeros if row[0] > 0 else state
        actions, state = act(row[None, 1:].copy(), state)
        sys.stdout.buffer.write(actions.astype(numpy.float32).tobytes())


if __name__ == "__main__":
    main()
