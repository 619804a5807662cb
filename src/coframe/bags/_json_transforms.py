# SPDX-License-Identifier: Apache-2.0
"""Transforms in JSON: Foxglove's FrameTransform and ROS's TFMessage, in the forms that different programs write.

Foxglove writes the fields as in its schema, with times of ``sec`` and ``nsec``. Tools of protobuf write camel case,
times of RFC 3339 or of ``seconds`` and ``nanos``, 64-bit integers as text, and no fields with default values. ROS
writes ``nanosec``, ROS 1 ``secs`` and ``nsecs``.
"""

from __future__ import annotations

import datetime
import json
import re
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe import time

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["StampedValues", "json_many", "json_one"]

_SECONDS = ("sec", "secs", "seconds")
_NANOSECONDS = ("nsec", "nsecs", "nanosec", "nanos", "nanoseconds")
_RFC_3339 = re.compile(r"(\d{4}-\d\d-\d\d)[Tt ](\d\d:\d\d:\d\d)(?:\.(\d{1,9}))?(?:[Zz]|([+-]\d\d:\d\d))", re.ASCII)
_EPOCH = datetime.datetime(1970, 1, 1, tzinfo=datetime.timezone.utc)
_MAX_EXACT_FLOAT = 1 << 53
_MAX_DIGITS = 20
# The fields of a transform, with their names in protobuf's JSON and in ROS.
_FIELDS = {
    "timestamp": ("timestamp", "stamp"),
    "parent": ("parent_frame_id", "parentFrameId", "frame_id"),
    "child": ("child_frame_id", "childFrameId"),
    "translation": ("translation",),
    "rotation": ("rotation",),
}
_NESTED_KEYS = ("header", "transform")  # objects with some of these fields, in ROS and in old schemas of Foxglove
_IGNORED_FIELDS = {"seq"}


class StampedValues(NamedTuple):
    """One transform; ``stamp`` is None if the message has none."""

    parent: str
    child: str
    stamp: int | None
    values: tuple[float, float, float, float, float, float, float]


def json_one(data: bytes | memoryview) -> Iterator[StampedValues]:
    """Decode a message that is a transform."""
    yield _parse_transform(json.loads(bytes(data)))


def json_many(data: bytes | memoryview) -> Iterator[StampedValues]:
    """Decode a message with a list of transforms."""
    message = _require_object(json.loads(bytes(data)), "the message")
    if message and "transforms" not in message:
        raise ValueError(f"no field 'transforms'; the fields are {_names(message)}")
    yield from map(_parse_transform, message.get("transforms") or [])


def _parse_transform(value: Any) -> StampedValues:
    fields: dict[str, Any] = {}
    unknown = _collect_fields(_require_object(value, "a transform"), fields)
    if unknown and "translation" not in fields:  # Protobuf omits a default, but another name is not a default.
        raise ValueError(f"a transform has no translation; its fields are {_names(unknown)}")
    if missing := {"parent", "child"} - set(fields):
        names = _names(_FIELDS[field][0] for field in sorted(missing))
        raise ValueError(f"a transform has no {names}; its fields are {_names(value)}")
    x, y, z = _read_numbers(fields.get("translation"), "translation", "xyz")
    qx, qy, qz, qw = _read_numbers(fields.get("rotation"), "rotation", "xyzw")
    stamp = fields.get("timestamp")
    nanoseconds = None if stamp is None else _parse_timestamp(stamp)
    return StampedValues(fields["parent"], fields["child"], nanoseconds, (x, y, z, qx, qy, qz, qw))


def _collect_fields(value: dict[str, Any], fields: dict[str, Any]) -> list[str]:
    """Add the fields of an object and of the objects in it, and return the names of all others."""
    unknown = []
    for name, content in value.items():
        field = next((key for key, names in _FIELDS.items() if name in names), None)
        if field is not None:
            # The time of the inner object of Foxglove's old schema repeats that of the outer one.
            fields.setdefault(field, content)
        elif name in _NESTED_KEYS:
            unknown += _collect_flat(_require_object(content, name), fields)
        elif name not in _IGNORED_FIELDS:
            unknown.append(name)
    return unknown


def _collect_flat(value: dict[str, Any], fields: dict[str, Any]) -> list[str]:
    if any(name in value for name in _NESTED_KEYS):
        raise ValueError("a transform with nested objects is not supported")
    return _collect_fields(value, fields)


def _read_numbers(value: Any, what: str, axes: str) -> list[float]:
    """Return the components of a vector or quaternion; omitted ones are 0, as in protobuf."""
    components = _require_object({} if value is None else value, what)
    if others := sorted(set(components) - set(axes)):
        raise ValueError(f"the {what} has the fields {_names(others)}, not {', '.join(axes)}")
    return [float(components.get(axis) or 0.0) for axis in axes]


def _parse_timestamp(stamp: Any) -> int:
    """Return a time in nanoseconds.

    Raises:
        ValueError: Its format is ambiguous, such as a number without a unit.
    """
    if isinstance(stamp, str) and (match := _RFC_3339.fullmatch(stamp.strip())):
        day, clock, fraction, offset = match.groups()
        whole_seconds = datetime.datetime.fromisoformat(f"{day}T{clock}{offset or '+00:00'}") - _EPOCH
        return (whole_seconds.days * 86400 + whole_seconds.seconds) * time.SECOND + int((fraction or "").ljust(9, "0"))
    if isinstance(stamp, dict) and stamp:
        seconds = [stamp[name] for name in _SECONDS if name in stamp]
        fractions = [stamp[name] for name in _NANOSECONDS if name in stamp]
        if len(seconds) <= 1 and len(fractions) <= 1 and len(seconds) + len(fractions) == len(stamp):
            # Protobuf omits zeros.
            fraction_ns = _parse_integer(fractions[0]) if fractions else 0
            if not 0 <= fraction_ns < time.SECOND:
                raise ValueError(f"a timestamp has {fraction_ns} nanoseconds in addition to its seconds")
            return (_parse_integer(seconds[0]) if seconds else 0) * time.SECOND + fraction_ns
    raise ValueError(f"unknown timestamp format: {json.dumps(stamp)[:80]}")


def _parse_integer(value: Any) -> int:
    """Return an integer from a string, a float such as 1.0, or the two 32-bit halves that JavaScript uses."""
    if isinstance(value, int) and not isinstance(value, bool):
        return value
    if isinstance(value, float) and value.is_integer() and abs(value) < _MAX_EXACT_FLOAT:
        return int(value)
    if isinstance(value, str) and len(value) <= _MAX_DIGITS and re.fullmatch(r"-?\d+", value, re.ASCII):
        return int(value)
    if isinstance(value, dict) and {"low", "high"} <= set(value) <= {"low", "high", "unsigned"}:
        return (_parse_integer(value["high"]) << 32) + (_parse_integer(value["low"]) & 0xFFFFFFFF)
    raise ValueError(f"a timestamp contains {json.dumps(value)[:80]}, which is not an integer")


def _require_object(value: Any, what: str) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise TypeError(f"{what} is not an object but {json.dumps(value)[:80]}")
    return value


def _names(names: Any) -> str:
    return ", ".join(map(str, names))[:200]
