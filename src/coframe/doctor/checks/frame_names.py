# SPDX-License-Identifier: Apache-2.0
"""TF006: frame names that cause problems: leading slashes, spaces, near-duplicates, incomplete prefixes."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import count, join_quoted
from coframe.doctor._finding import Finding, Severity
from coframe.doctor._rules import rename_frame

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF006"
_MAX_PREFIXES = 5  # in front of one name
_PLAIN_NAME = re.compile(r"[\w./-]+")


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per kind of problem."""
    yield from _find_slashes(observation)
    yield from _find_unusual_characters(observation)
    yield from _find_near_duplicates(observation)
    yield from _incomplete_prefix(observation)


def _find_slashes(observation: Observation) -> Iterator[Finding]:
    transforms = observation.transforms
    sent = transforms.sent or transforms.names
    numbers = [number for number, name in enumerate(sent) if name.startswith("/") and name.lstrip("/")]
    if numbers:
        rows = np.flatnonzero(np.isin(transforms.parent, numbers) | np.isin(transforms.child, numbers))
        names = [sent[number] for number in numbers]
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{count(len(names), 'frame name')} with a leading slash: {join_quoted(names)}",
            fix=f"Remove the slash where the name is set: {names[0].lstrip('/')!r}. tf2 rejects such names in lookups. "
            "The parameter frame_prefix is put in front of names unchanged and must end with the slash: 'robot1/'.",
            frames=frozenset(transforms.names[number].lstrip("/") for number in numbers),
            repairs=("strip-slashes",),
            first_stamp=int(transforms.stamp[rows[0]]) if len(rows) else None,
            publishers=transforms.publishers_of(rows),
        )


def _find_unusual_characters(observation: Observation) -> Iterator[Finding]:
    unusual = [frame for frame in observation.frames if not _PLAIN_NAME.fullmatch(frame)]
    if unusual:
        yield Finding(
            code=CODE,
            severity=Severity.NOTE,
            text=f"{count(len(unusual), 'frame name')} with spaces or other characters that some tools do not accept: "
            f"{join_quoted(unusual)}",
            fix=f"Use only letters, digits and '_': {re.sub(r'[^0-9A-Za-z_/]+', '_', unusual[0]).strip('_')!r}.",
            frames=frozenset(unusual),
        )


def _find_near_duplicates(observation: Observation) -> Iterator[Finding]:
    groups: dict[str, list[str]] = {}
    for frame in observation.frames:
        groups.setdefault(re.sub(r"[ _.-]", "", frame).lower(), []).append(frame)
    for names in groups.values():
        if len(names) > 1:
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"frame names that differ only in case, spaces or punctuation: {join_quoted(names)}",
                fix=f"If they are meant to be one frame, use {names[0]!r} everywhere.",
                frames=frozenset(names),
                choices=tuple(rename_frame(old, new) for new in names for old in names if old != new),
            )


def _incomplete_prefix(observation: Observation) -> Iterator[Finding]:
    """Yield a finding for a tree whose root, with or without a prefix, is a frame of another tree."""
    if len(observation.trees) < 2:
        return
    for prefixed in observation.frames:
        for plain in _names_without_prefixes(prefixed):
            roots = observation.roots.get(prefixed), observation.roots.get(plain)
            if roots[1] is not None and roots[0] != roots[1] and {prefixed, plain} & set(roots):
                prefix = prefixed.removesuffix(plain)
                yield Finding(
                    code=CODE,
                    severity=Severity.WARNING,
                    text=f"incomplete prefix: {prefixed!r} and {plain!r} are in two separate trees",
                    fix="Set the prefix for all publishers of the robot (robot_state_publisher: "
                    f"frame_prefix:={prefix}; odometry: base_frame_id:={prefixed}), or for none.",
                    frames=frozenset({prefixed, plain}),
                    choices=(rename_frame(plain, prefixed), rename_frame(prefixed, plain)),
                )
                return


def _names_without_prefixes(frame: str) -> Iterator[str]:
    """Yield ``b/c`` and ``c`` for ``a/b/c``."""
    for _ in range(_MAX_PREFIXES):
        _, slash, frame = frame.partition("/")
        if not slash:
            return
        yield frame
