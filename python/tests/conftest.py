# SPDX-License-Identifier: Apache-2.0
import pathlib

import pytest

import skein

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def heading_policy() -> skein.Agent:
    return skein.load_policy(ROOT / "policies" / "heading.skein")
