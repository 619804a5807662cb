# SPDX-License-Identifier: Apache-2.0
"""The page of environment variables has every variable that the code reads, and no other."""

import re
from pathlib import Path

import pytest

from coframe.system._variables import _EFFECTS

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "reference" / "environment.md"
# Strings that begin as variables do, and names that are used with an environment.
NAME = re.compile(
    r'"((?:AMENT|COFRAME|CYCLONEDDS|FASTDDS|FASTRTPS|RCUTILS|RMW|ROS|ZENOH|XDG)_[A-Z0-9_]*[A-Z0-9])"'
    r'|environ(?:ment)?(?:\.(?:get|pop|setdefault)\(|\[)"([A-Z][A-Z0-9_]+)"|getenv\("([A-Z][A-Z0-9_]+)"'
)
NOT_VARIABLES = {"ROS_TYPE", "AMENT_IGNORE"}  # an attribute of message classes, a file
OF_CLIENTS = {"AWS_ACCESS_KEY_ID"}  # read by libraries
SOURCES = [
    file
    for folder in ("src", "native", "middlewares")
    for file in (ROOT / folder).rglob("*")
    if file.suffix in {".py", ".cpp", ".hpp"} and "build" not in file.parts
]


@pytest.fixture(scope="module")
def sources():
    return "\n".join(file.read_text(encoding="utf-8") for file in SOURCES)


@pytest.fixture(scope="module")
def read(sources):
    return {name for match in NAME.finditer(sources) for name in match.groups() if name} - NOT_VARIABLES


def _on_page():
    return set(re.findall(r"`([A-Z][A-Z0-9_]{3,})`", PAGE.read_text(encoding="utf-8")))


def test_every_variable_that_is_read_is_on_the_page(read):
    assert read - _on_page() == set()


def test_the_page_has_only_variables_of_the_code(read, sources):
    values = {"LOCALHOST", "SUBNET", "SYSTEM_DEFAULT", "LARGE_DATA", "SYNCHRONOUS", "ASYNCHRONOUS", "AUTO"}
    others = _on_page() - read - values - OF_CLIENTS
    assert {name for name in others if not re.search(rf"\b{name}\b", sources)} == set()


def test_the_doctor_explains_variables_of_the_page():
    assert set(_EFFECTS) <= _on_page()
