# SPDX-License-Identifier: Apache-2.0
"""The columns of trajectory files, by the names in a header line."""

from __future__ import annotations

import re
from typing import NamedTuple

from coframe.time import SECOND

__all__ = ["Columns", "header_columns", "is_separated_by_spaces", "split"]

_POSE = ("x", "y", "z", "qx", "qy", "qz", "qw")
_UNIT = re.compile(r"\[(.*?)\]|\((.*?)\)")
_STAMP = re.compile(
    r"(?:header[._])?(?:time_?stamp|stamp|time|t)(?:[._ ]?(ns|nsecs?|nanoseconds?|us|ms|s|secs?|seconds?))?"
)
_ROTATION = re.compile(r"(?:.*[.])?(?:q|quat|quaternion|orientation|rotation|rot)(?:[._].*)?[._]?([xyzw])")
_POSITION = re.compile(r"(?:(?:.*[.])?(?:p|t|pos|position|trans|translation)(?:[._].*)?[._]?)?([xyz])")
_DECIMAL_COMMA = re.compile(r"[+-]?\d+(?:,\d+)?(?:[eE][+-]?\d+)?|nan", re.ASCII | re.IGNORECASE)
_MIN_CELLS = 8  # of a pose with its time
_UNITS = {"n": 1, "u": 1_000, "m": 1_000_000, "s": SECOND}  # by the first letter


class Columns(NamedTuple):
    """The positions of the values of a pose in a row.

    Attributes:
        stamp: Index of the time.
        pose: Indices of x, y, z, qx, qy, qz and qw.
        unit: The unit of the times in nanoseconds; None if the header does not name it.
    """

    stamp: int
    pose: tuple[int, ...]
    unit: int | None


def split(line: str) -> list[str]:
    """Return the cells of a line, which are separated by commas, semicolons, tabs or spaces.

    Numbers may have a decimal comma if another character separates them.
    """
    cells = [cell.strip() for cell in line.split(";")] if ";" in line else line.split()
    if len(cells) >= _MIN_CELLS and "," in line and all(map(_DECIMAL_COMMA.fullmatch, cells)):
        return [cell.replace(",", ".") for cell in cells]
    for separator in ",;":
        if separator in line:
            return [cell.strip() for cell in line.split(separator)]
    return line.split()


def is_separated_by_spaces(line: str) -> bool:
    """Return whether spaces or tabs separate the cells of a line."""
    return split(line) == line.replace(",", ".").split()


def header_columns(line: str) -> Columns | None:
    """Return the columns that a header line names; None if it does not name each value of a pose exactly once."""
    text = line.lstrip("#%").strip().lower()
    names = split(text if "," in text or ";" in text else re.sub(r"\s+(?=[\[(])", "", text))
    found: dict[str, int] = {}
    unit = None
    for index, cell in enumerate(names):
        brackets = _UNIT.search(cell)
        name = _UNIT.sub("", cell).strip(' "')
        stamp = _STAMP.fullmatch(name)
        meaning = "stamp" if stamp else _meaning(name)
        if meaning in found:
            return None
        if meaning:
            found[meaning] = index
        if stamp:
            written = stamp[1] or (brackets and (brackets[1] or brackets[2])) or ""
            unit = _UNITS.get(written.strip()[:1])
    if set(found) != {"stamp", *_POSE}:
        return None
    return Columns(found["stamp"], tuple(found[name] for name in _POSE), unit)


def _meaning(name: str) -> str:
    if match := _ROTATION.fullmatch(name):
        return f"q{match[1]}"
    match = _POSITION.fullmatch(name)
    return match[1] if match else ""
