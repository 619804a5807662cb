# SPDX-License-Identifier: Apache-2.0
"""docs/reference/limits.md states the limits that the code has."""

import importlib
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "reference" / "limits.md"
UNITS = {"": 1, "MiB": 1 << 20, "GiB": 1 << 30, "s": 1, "Hz": 1}
ROWS = re.findall(
    r"^\| ([^|]+) \| ([^|]+) \| `([^`|]+)` \| ([^|]+) \|$", PAGE.read_text(encoding="utf-8"), re.MULTILINE
)


def native_value(path, name):
    """Return the value of a constant in C++: 250'000, 64 << 20, 1024."""
    text = (ROOT / path).read_text(encoding="utf-8")
    number = re.search(rf"\b{name} = ([\d'<< ]+)[,;]", text)
    first, _, shift = number[1].replace("'", "").partition("<<")
    return int(first) << int(shift or 0)


def test_every_row_of_the_page_has_a_constant():
    lines = [
        line for line in PAGE.read_text(encoding="utf-8").splitlines() if line.startswith("| ") and "---" not in line
    ]
    assert len(ROWS) == len(lines) - 5, "a heading for each of five tables, and rows of four columns"
    assert len(ROWS) > 40


@pytest.mark.parametrize(("resource", "limit", "owner"), [row[:3] for row in ROWS])
def test_the_limit_is_that_of_the_code(resource, limit, owner):
    number, unit = re.fullmatch(r"([\d ]+?) ?([A-Za-z]*)", limit).groups()
    if owner.startswith("native/"):
        actual = native_value(*owner.split(":"))
    else:
        module, _, name = owner.rpartition(".")
        actual = getattr(importlib.import_module(module), name)
    assert int(number.replace(" ", "")) * UNITS[unit] == actual, resource
