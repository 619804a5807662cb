# SPDX-License-Identifier: Apache-2.0
"""The arguments of static_transform_publisher: named options, or the deprecated positional numbers."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["ArgumentError", "StaticArguments", "parse"]

TRANSLATION = ("--x", "--y", "--z")
QUATERNION = ("--qx", "--qy", "--qz", "--qw")
EULER = ("--roll", "--pitch", "--yaw")
NUMBERS = (*TRANSLATION, *QUATERNION, *EULER)
NAMES = ("--frame-id", "--child-frame-id", "--domain", "--tf-topic", "--tf-static-topic", "--prefix", "--keep")


class ArgumentError(ValueError):
    """Invalid arguments. The messages are those of static_transform_publisher if it has one."""


@dataclass
class StaticArguments:
    """The static transform given on the command line, and where to publish it."""

    frame_id: str
    child_frame_id: str
    transform: Transform
    old_style: bool = False
    domain: int | None = None
    tf_static_topic: str = "/tf_static"
    prefix: str = ""
    keep: str = ""


@dataclass
class _Flags:
    numbers: dict[str, float] = field(default_factory=dict)
    names: dict[str, str] = field(default_factory=dict)
    positional: list[str] = field(default_factory=list)


def parse(words: Sequence[str]) -> StaticArguments:
    """Parse ``--x 1 --frame-id a ...``, ``x y z yaw pitch roll frame child`` or ``x y z qx qy qz qw frame child``.

    Raises:
        ArgumentError: An argument is missing, unknown or not a number, or two of them conflict.
    """
    flags = _flags(words)
    arguments = _transform(flags)
    arguments.domain = _parse_domain(flags.names.get("--domain"))
    arguments.tf_static_topic = "/" + flags.names.get("--tf-static-topic", "/tf_static").removeprefix("/")
    arguments.prefix, arguments.keep = flags.names.get("--prefix", ""), flags.names.get("--keep", "")
    return arguments


def _transform(flags: _Flags) -> StaticArguments:
    if not flags.positional:
        return _parse_new_style(flags)
    if flags.numbers or {"--frame-id", "--child-frame-id"} & set(flags.names):
        raise ArgumentError("Cannot specify both new-style (flags) and old-style (arguments)")
    return _parse_old_style(flags.positional)


def _flags(arguments: Sequence[str]) -> _Flags:
    flags = _Flags()
    rest = iter(arguments)
    for argument in rest:
        if not argument.startswith("--"):
            flags.positional.append(argument)
            continue
        flag, equals, value = argument.partition("=")
        if flag not in NUMBERS and flag not in NAMES:
            raise ArgumentError(f"Extra unparsed arguments on command-line: {flag}")
        if not equals:
            value = _value(flag, rest)
        if flag in NUMBERS:
            flags.numbers[flag] = _number(value, flag)
        else:
            flags.names[flag] = value
    return flags


def _value(flag: str, rest: Sequence[str] | object) -> str:
    value = next(rest, None)  # type: ignore[call-overload]
    if value is None:
        raise ArgumentError(f"Not enough arguments for {flag}")
    return str(value)


def _number(text: str, flag: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise ArgumentError(f"Failed to parse {flag} argument as float")
    return number


def _parse_domain(text: str | None) -> int | None:
    if text is None:
        return None
    if not re.fullmatch("[0-9]{1,3}", text) or int(text) > 232:
        raise ArgumentError(f"--domain must be an integer from 0 to 232, not {text[:60]!r}")
    return int(text)


def _parse_new_style(flags: _Flags) -> StaticArguments:
    numbers = flags.numbers
    if any(flag in numbers for flag in QUATERNION) and any(flag in numbers for flag in EULER):
        raise ArgumentError("Cannot specify both quaternion and Euler rotations")
    translation = [numbers.get(flag, 0.0) for flag in TRANSLATION]
    if any(flag in numbers for flag in QUATERNION):
        quaternion = [numbers.get(flag, 1.0 if flag == "--qw" else 0.0) for flag in QUATERNION]
        transform = _from_quaternion(translation, quaternion)
    else:
        transform = Transform.from_rpy(translation, [numbers.get(flag, 0.0) for flag in EULER])
    frame_id, child_frame_id = flags.names.get("--frame-id", ""), flags.names.get("--child-frame-id", "")
    _check_names(frame_id, child_frame_id)
    return StaticArguments(frame_id, child_frame_id, transform)


def _parse_old_style(positional: list[str]) -> StaticArguments:
    if len(positional) not in {8, 9}:
        raise ArgumentError("Extra unparsed arguments on command-line")
    *texts, frame_id, child_frame_id = positional
    labels = ("x", "y", "z", "yaw", "pitch", "roll") if len(texts) == 6 else ("x", "y", "z", "qx", "qy", "qz", "qw")
    numbers = [_number(text, label) for text, label in zip(texts, labels, strict=True)]
    if len(numbers) == 6:
        transform = Transform.from_rpy(numbers[:3], numbers[:2:-1])  # The positional order is yaw, pitch, roll.
    else:
        transform = _from_quaternion(numbers[:3], numbers[3:])
    _check_names(frame_id, child_frame_id)
    return StaticArguments(frame_id, child_frame_id, transform, old_style=True)


def _from_quaternion(translation: list[float], quaternion: list[float]) -> Transform:
    if not any(quaternion):
        raise ArgumentError("The quaternion must not be zero")
    return Transform(translation, quaternion)


def _check_names(frame_id: str, child_frame_id: str) -> None:
    if not frame_id:
        raise ArgumentError("Frame id must not be empty")
    if not child_frame_id:
        raise ArgumentError("Child frame id must not be empty")
    for name in (frame_id, child_frame_id):
        try:
            name.encode()
        except UnicodeEncodeError:
            raise ArgumentError(f"Frame ids must be valid UTF-8, not {name!r}") from None
