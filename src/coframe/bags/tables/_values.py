# SPDX-License-Identifier: Apache-2.0
"""Arrays of the values of a column, chosen or interpolated between messages."""

from __future__ import annotations

import json
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.bags.tables._leaves import MissingElementError, at_path
from coframe.errors import RecordingError
from coframe.time import SECOND
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from coframe.bags.tables._leaves import Leaf
    from coframe.bags.tables._matching import MatchedRows

__all__ = ["Values", "check_interpolation", "values_at"]

_MIN_NORM = 1e-3  # of a quaternion; drivers without an orientation publish zeros
_NON_NUMERIC_KINDS = {
    "boolean": "a boolean",
    "text": "a string",
    "bytes": "a block of bytes",
    "list": "a sequence of messages",
}


class Values:
    """The values of one leaf in several messages.

    Attributes:
        array: (M,), or (M, K) for arrays; object for strings and sequences.
        known: Whether a message has the value, (M,).
    """

    def __init__(self, leaf: Leaf, raw: Sequence[Any]) -> None:
        values = [None if value is None else _convert_value(value, leaf) for value in raw]
        self.known: NDArray[np.bool_] = np.array([value is not None for value in values], dtype=bool)
        self.array: NDArray[Any]
        if leaf.kind == "numbers" or leaf.dtype.kind == "O":
            self.array = np.empty(len(values), dtype=object)
            for row, value in enumerate(values):
                self.array[row] = value
            return
        missing: Any = np.zeros(leaf.size, leaf.dtype) if leaf.kind == "array" else leaf.dtype.type(0)
        if leaf.dtype.kind == "f":
            missing = missing + np.nan
        filled = [missing if value is None else value for value in values]
        shape = (len(values), leaf.size) if leaf.kind == "array" else (len(values),)
        self.array = np.array(filled, dtype=leaf.dtype).reshape(shape)


def check_interpolation(label: str, leaves: Sequence[Leaf]) -> None:
    """Raise a RecordingError if a value cannot be interpolated."""
    for leaf in leaves:
        if leaf.kind in _NON_NUMERIC_KINDS:
            below = "Choose a field with numbers, or a" if leaf.steps else "A"
            raise RecordingError(
                f"{label}{leaf.suffix} is {_NON_NUMERIC_KINDS[leaf.kind]}, which cannot be interpolated",
                hint=f'{below}nother method for this column: Column("{label}", "nearest"), or {label}@nearest.',
            )


def values_at(
    leaves: Sequence[Leaf], raw: Sequence[tuple[Any, ...] | None], picks: MatchedRows, *, interpolate: bool
) -> tuple[list[NDArray[Any]], list[NDArray[np.bool_]]]:
    """Return the values of a column at N times, and whether they exist.

    Args:
        leaves: The values of the column.
        raw: Their values in each of M messages.
        picks: The messages, as indices into ``raw``.
        interpolate: Whether to interpolate between two messages.
    """
    empty = (None,) * len(leaves)
    rows = list(zip(*(empty if row is None else row for row in raw), strict=True)) or [()] * len(leaves)
    columns = [Values(leaf, values) for leaf, values in zip(leaves, rows, strict=True)]
    known = [picks.valid & each.known[picks.first] & each.known[picks.second] for each in columns]
    if not interpolate:
        return [each.array[picks.first] for each in columns], known
    found = [
        _interpolate(each.array[picks.first], each.array[picks.second], picks.share, leaf)
        for leaf, each in zip(leaves, columns, strict=True)
    ]
    for start in range(len(leaves) - 3):
        if {leaf.axis for leaf in leaves[start : start + 4]} == set("xyzw"):
            _interpolate_rotations(leaves, columns, picks, start, found, known)
    return found, known


def _interpolate(first: NDArray[Any], second: NDArray[Any], share: NDArray[np.float64], leaf: Leaf) -> NDArray[Any]:
    if leaf.kind == "time":
        return np.asarray(first + np.rint((second - first) * share).astype(np.int64))
    if leaf.kind == "numbers":
        mixed = np.empty(len(first), dtype=object)
        for row, (one, other) in enumerate(zip(first, second, strict=True)):
            mixed[row] = _mix_sequences(one, other, share[row])
        return mixed
    weight = share if first.ndim == 1 else share[:, None]
    return _mix_arrays(first.astype(np.float64), second.astype(np.float64), weight)


def _mix_sequences(first: Any, second: Any, share: float) -> Any:
    """Return a sequence between two of the same length, or None if their lengths differ."""
    if first is None or second is None or len(first) != len(second):
        return None
    return _mix_arrays(first.astype(np.float64), second.astype(np.float64), np.full(len(first), share))


def _mix_arrays(first: NDArray[np.float64], second: NDArray[np.float64], share: NDArray[np.float64]) -> NDArray[Any]:
    with np.errstate(invalid="ignore", over="ignore"):
        mixed = (1.0 - share) * first + share * second
    # At the stamp of a message, and between equal values, the value is exact: also if it is infinite.
    return np.where((share == 0) | (first == second), first, np.where(share == 1, second, mixed))


def _interpolate_rotations(
    leaves: Sequence[Leaf],
    columns: Sequence[Values],
    picks: MatchedRows,
    start: int,
    found: list[NDArray[Any]],
    known: list[NDArray[np.bool_]],
) -> None:
    """Replace the components of a quaternion by those of the rotation between two messages."""
    place = {leaf.axis: start + number for number, leaf in enumerate(leaves[start : start + 4])}
    order = [place[axis] for axis in "xyzw"]
    one, other = (
        np.stack([columns[index].array[rows] for index in order], axis=1).astype(np.float64)
        for rows in (picks.first, picks.second)
    )
    is_between = (picks.share > 0) & (one != other).any(axis=1)
    norms = np.minimum(np.linalg.norm(one, axis=1), np.linalg.norm(other, axis=1))
    with np.errstate(invalid="ignore"):
        usable = is_between & (norms > _MIN_NORM) & np.isfinite(norms)
    result = np.where(is_between[:, None], np.nan, one)
    if usable.any():
        origin = np.zeros((int(usable.sum()), 3))
        begin, end = Transform(origin, one[usable]), Transform(origin, other[usable])
        result[usable] = begin.interpolate(end, picks.share[usable]).quaternion
    for column, index in enumerate(order):
        found[index] = result[:, column]
        known[index] = known[index] & (usable | ~is_between)


def _convert_value(value: Any, leaf: Leaf) -> Any:
    """Convert a value of a message for NumPy. Return None if its type differs from other messages."""
    try:
        return _CONVERSIONS[leaf.kind](value, leaf)
    except (TypeError, ValueError, OverflowError, LookupError):
        return None


def _nanoseconds(value: Any) -> int:
    for pair in (("sec", "nanosec"), ("seconds", "nanos"), ("secs", "nsecs"), ("sec", "nsec")):
        with suppress(MissingElementError):
            seconds, nanoseconds = (int(at_path(value, (name,))) for name in pair)
            return seconds * SECOND + nanoseconds
    raise TypeError(f"not a time: {value!r}")


_CONVERSIONS: dict[str, Callable[[Any, Leaf], Any]] = {
    "time": lambda value, _: _nanoseconds(value),
    # The value of an octet is a byte.
    "number": lambda value, leaf: leaf.dtype.type(value[0] if isinstance(value, bytes) else value),
    "boolean": lambda value, leaf: leaf.dtype.type(value),
    "numbers": lambda value, leaf: np.array(value, dtype=leaf.dtype),
    "array": lambda value, _: value,
    "bytes": lambda value, _: bytes(value),
    "text": lambda value, _: value if isinstance(value, str) else json.dumps(value, default=str),
    "list": lambda value, _: value,
}
