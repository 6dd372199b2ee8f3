# SPDX-License-Identifier: Apache-2.0
import dataclasses
import importlib.util
import inspect
import json
import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT

import skein


def test_the_reference_is_that_of_the_docstrings():
    command = [sys.executable, ROOT / "scripts" / "python_reference"]
    made = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert made == (ROOT / "docs" / "reference" / "python-api.md").read_text()


ALIASES = ("AgentLike", "Rule", "Task")  # of types
NAMES = [name for name in skein.__all__ if name not in ALIASES and callable(getattr(skein, name))]


@pytest.mark.parametrize("name", NAMES)
def test_everything_is_documented(name):
    thing = getattr(skein, name)
    assert thing.__doc__
    if inspect.isclass(thing):  # one of data without a docstring gets a signature from Python
        assert not thing.__doc__.startswith(f"{name}(")


def test_whoever_takes_a_task_takes_all_that_may_be_one():
    functions = [skein.configure, skein.make, skein.make_vec, skein.evaluate, skein.compare, skein.record, skein.train,
                 skein.Agent, skein.FlightEnv, skein.FlightVectorEnv]
    for function in functions:
        assert inspect.signature(function).parameters["task"].annotation == "Task", function


@pytest.mark.parametrize("error,base", [(skein.Error, "RuntimeError"), (skein.ConfigurationError, "ValueError")])
def test_errors_say_what_they_are(error, base):
    assert base in (error.__doc__ or "")
    assert f"\n{error.__doc__}\n" in (ROOT / "docs" / "reference" / "python-api.md").read_text()


def test_the_licence_of_what_the_extension_contains_lies_beside_it():
    assert "Redistributions in binary form" in Path(skein.__file__).with_name("nanobind-LICENSE.txt").read_text()


def test_help_says_what_arrays_hold():
    """Docstrings behind fields are in the reference, but not in help()."""
    for cls in (value for name in skein.__all__ if dataclasses.is_dataclass(value := getattr(skein, name))):
        for field in dataclasses.fields(cls):
            if "Array" in str(field.type):
                assert f"`{field.name}`" in cls.__doc__, (cls, field.name)
    for name, value in vars(skein).items():
        if name.isupper() and name in skein.__all__:
            assert name in skein.__doc__, name
    for thing in (skein.Trim, skein.LinearModel, skein.linearise, skein.simulate):
        for said in ("STATE_NAMES", "CONTROL_NAMES", "ft/s", "rad/s", "lbf", "deg"):
            assert said in thing.__doc__, (thing, said)


def test_help_names_what_linear_models_holds():
    models = skein.linear_models(skein.trim(15000, 500))
    bare, loops = models["bare_airframe"], models["with_flight_control"]
    quantities = [*bare["states"], *bare["inputs"], *bare["outputs"], *(loop["inputs"][0] for loop in loops.values())]
    said = skein.linear_models.__doc__
    for name in (*models, *bare, *loops, *bare["modes"][0], *(quantity["name"] for quantity in quantities)):
        assert name in said, name
    for name in "ABCD":
        assert str(bare[name].shape) in said, name
    for mode in bare["modes"]:
        assert f'"{mode["name"]}"' in said


def test_the_reference_has_every_name_and_no_docstring_of_another_library():
    page = (ROOT / "docs" / "reference" / "python-api.md").read_text()
    missing = [name for name in skein.__all__ if f"## skein.{name}\n" not in page and f"- `{name}`" not in page]
    assert missing == ["__version__", "simd_target"]
    for cls in (skein.FlightEnv, skein.FlightVectorEnv, skein.FlightColumns):
        for name, value in vars(cls).items():
            if inspect.isfunction(value) and not value.__doc__ and (inherited := inspect.getdoc(value)):
                assert inherited.splitlines()[0] not in page, name


def test_the_examples_of_the_page_run(tmp_path, monkeypatch):
    page = (ROOT / "docs" / "how-to" / "python.md").read_text()
    code = "\n".join(re.findall(r"^ *```python\n(.*?)^ *```", page, re.M | re.S))
    code = re.sub(r"^  (?=skein)", "", code, flags=re.M)
    # Smaller, and where nothing is left behind.
    replaced = [("range(1000)", "range(3)"), ("4096", "64"), ("episodes=1000", "episodes=8"),
                ("episodes=500", "episodes=8"), ("5_000_000", "500_000"), ('"policies/', f'"{ROOT}/policies/'),
                ("my_network(observations)", "observations[:, :4]")]
    if importlib.util.find_spec("matplotlib") is None:
        replaced.append(("run.metrics.plot", "(lambda *_: 0)"))
    for old, new in replaced:
        assert old in code, old
        code = code.replace(old, new)
    monkeypatch.setenv("MPLBACKEND", "agg")
    monkeypatch.chdir(tmp_path)
    exec(compile(code, "docs/how-to/python.md", "exec"), {})


def test_the_tutorials_cells_run(monkeypatch):
    pytest.importorskip("pandas")
    cells = json.loads((ROOT / "docs" / "python-tutorial.ipynb").read_text())["cells"]
    monkeypatch.chdir(ROOT)
    namespace = {}
    for cell in cells:
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), f"cell {cell['id']}", "exec"), namespace)
    assert namespace["trained"].task == "heading"
