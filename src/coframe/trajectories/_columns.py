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
    r"(?:.*[.])?(?:header[._])?(?:time_?stamp|stamp|time|t)(?:[._ ]?(ns|nsecs?|nanoseconds?|us|ms|s|secs?|seconds?))?"
)
_ROTATION = re.compile(r"(?:.*[.])?(?:q|quat|quaternion|orientation|rotation|rot)(?:[._].*)?[._]?([xyzw])")
_POSITION = re.compile(r"(?:(?:.*[.])?(?:p|t|pos|position|trans|translation)(?:[._].*)?[._]?)?([xyz])")
_DECIMAL_COMMA = re.compile(r"[+-]?\d+(?:,\d+)?(?:[eE][+-]?\d+)?|nan", re.ASCII | re.IGNORECASE)
_MIN_CELLS = 8  # of a pose with its time
_NANOSECONDS = re.compile(r"(?:.*[._ ])?(?:nanosec|nsecs?|nanosecs|nanoseconds?)")
_WHOLE_SECONDS = re.compile(r"secs?|seconds?")
_LENGTHS = {"": 1.0, "m": 1.0, "meters": 1.0, "cm": 0.01, "mm": 0.001, "km": 1000.0}
_UNITS = {"n": 1, "u": 1_000, "m": 1_000_000, "s": SECOND}  # by the first letter


class Columns(NamedTuple):
    """The positions of the values of a pose in a row.

    Attributes:
        stamp: Index of the time.
        pose: Indices of x, y, z, qx, qy, qz and qw.
        unit: The unit of the times in nanoseconds, or None if the header does not name it.
        nanoseconds: Index of the nanoseconds, if the time is divided into seconds and nanoseconds, or -1 otherwise.
        scale: The unit of the positions in meters.
    """

    stamp: int
    pose: tuple[int, ...]
    unit: int | None
    nanoseconds: int = -1
    scale: float = 1.0


def split(line: str) -> list[str]:
    """Return the cells of a line, which are separated by commas, semicolons, tabs or spaces.

    Numbers may have a decimal comma if another character separates them.
    """
    cells = [cell.strip() for cell in line.split(";")] if ";" in line else line.split()
    if len(cells) >= _MIN_CELLS and "," in line and all(map(_DECIMAL_COMMA.fullmatch, cells)):
        return [cell.replace(",", ".") for cell in cells]
    for separator in ",;":
        if separator in line:
            return [cell.strip().strip('"') for cell in line.split(separator)]
    return line.split()


def is_separated_by_spaces(line: str) -> bool:
    """Return whether spaces or tabs separate the cells of a line."""
    return split(line) == line.replace(",", ".").split()


def header_columns(line: str) -> Columns | None:
    """Return the columns that a header line names, or None if it does not name each value of a pose exactly once.

    Raises:
        ValueError: It names an unknown unit of the positions.
    """
    text = line.lstrip("#%").strip().lower()
    names = split(text if "," in text or ";" in text else re.sub(r"\s+(?=[\[(])", "", text))
    found: dict[str, int] = {}
    units: dict[str, str] = {}
    for index, cell in enumerate(names):
        brackets = _UNIT.search(cell)
        name = _UNIT.sub("", cell).strip(' "').replace("/", ".").lstrip("._%")
        meaning = _column_meaning(name)
        if meaning == "stamp" and "stamp" in found:
            if "header" not in name:
                continue  # The stamp of the header is the time of the measurement.
            del found["stamp"]
        if meaning in found:
            return None
        if meaning:
            found[meaning] = index
            written = (brackets[1] or brackets[2] or "") if brackets else ""
            units[meaning] = (written or _unit_in(name)).strip()
    return _columns(line, found, units)


def _columns(line: str, found: dict[str, int], units: dict[str, str]) -> Columns | None:
    """Return the columns, given the index and the unit of each value."""
    unit = _UNITS.get(units.get("stamp", "")[:1])
    nanoseconds, seconds = found.pop("nanoseconds", -1), found.pop("seconds", -1)
    if "stamp" not in found and nanoseconds >= 0:
        found["stamp"], nanoseconds, unit = (seconds, nanoseconds, SECOND) if seconds >= 0 else (nanoseconds, -1, 1)
    if set(found) != {"stamp", *_POSE}:
        return None
    lengths = {units[axis] for axis in "xyz"}
    if len(lengths) != 1 or (length := lengths.pop()) not in _LENGTHS:
        raise ValueError(f"the unit of the positions is unknown: {line[:200]!r}; known units: {', '.join(_LENGTHS)}")
    is_divided = nanoseconds >= 0 and unit in {None, SECOND}
    return Columns(
        found["stamp"],
        tuple(found[name] for name in _POSE),
        SECOND if is_divided else unit,
        nanoseconds if is_divided else -1,
        _LENGTHS[length],
    )


def _unit_in(name: str) -> str:
    """Return the unit in the name of a time, such as ``stamp_ns``, or "" if it has none."""
    stamp = _STAMP.fullmatch(name)
    return (stamp[1] or "") if stamp else ""


def _column_meaning(name: str) -> str:
    """Return which value a column name refers to, or "" if it is unknown."""
    for meaning, pattern in (("nanoseconds", _NANOSECONDS), ("seconds", _WHOLE_SECONDS), ("stamp", _STAMP)):
        if pattern.fullmatch(name):
            return meaning
    if match := _ROTATION.fullmatch(name):
        return f"q{match[1]}"
    match = _POSITION.fullmatch(name)
    return match[1] if match else ""
