# SPDX-License-Identifier: Apache-2.0
import ast
import pathlib
from collections.abc import Mapping

import skein
from skein import _skein


def names_of(body):
    """What a stub declares: its names, and those of its classes as CLASS.NAME."""
    for node in body:
        if isinstance(node, ast.AnnAssign):
            yield node.target.id
        elif isinstance(node, ast.FunctionDef):
            yield node.name
        elif isinstance(node, ast.ClassDef):
            yield node.name
            yield from (f"{node.name}.{name}" for name in names_of(node.body))


def names_in(module):
    """What the module has beside what every module and class has."""
    for name, value in vars(module).items():
        if name.startswith("__") and name != "__version__":
            continue
        yield name
        if isinstance(value, type):
            yield from (f"{name}.{member}" for member in vars(value) if not member.startswith("_"))


def test_the_stub_declares_what_the_extension_has():
    stub = pathlib.Path(skein.__file__).with_name("_skein.pyi").read_text()
    declared = {name for name in names_of(ast.parse(stub).body) if ".__" not in name}
    assert declared == set(names_in(_skein))


def test_a_configuration_is_a_mapping_by_its_types_too():
    stub = ast.parse(pathlib.Path(skein.__file__).with_name("_skein.pyi").read_text())
    config = next(node for node in stub.body if isinstance(node, ast.ClassDef) and node.name == "Config")
    assert [ast.unparse(base) for base in config.bases] == ["Mapping[str, Any]"]
    assert isinstance(skein.configure("heading"), Mapping)
