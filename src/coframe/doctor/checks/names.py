"""TF006: names of frames that trip programs: slashes in front, blanks, near-duplicates, half a prefix."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.phrases import quoted

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF006"
_LEVELS = 5  # of prefixes in front of each other
_PLAIN = re.compile(r"[\w./-]+")


def find(observation: Observation) -> Iterator[Finding]:
    """One finding a kind of oddity."""
    yield from _slashes(observation)
    yield from _characters(observation)
    yield from _nearly_the_same(observation)
    yield from _half_a_prefix(observation)


def _slashes(observation: Observation) -> Iterator[Finding]:
    told = observation.transforms
    sent = told.sent or told.names
    numbers = [number for number, name in enumerate(sent) if name.startswith("/") and name.lstrip("/")]
    if numbers:
        rows = np.flatnonzero(np.isin(told.parent, numbers) | np.isin(told.child, numbers))
        names = [sent[number] for number in numbers]
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{len(names)} names begin with a slash: {quoted(names)}",
            fix=f"Leave it off where they are set: {names[0].lstrip('/')!r}. tf2 refuses such names in look-ups; "
            "the setting frame_prefix is put in front as it is and needs its slash behind: 'robot1/'.",
            frames=frozenset(told.names[number].lstrip("/") for number in numbers),
            first_stamp=int(told.stamp[rows[0]]) if len(rows) else None,
            publishers=told.senders(rows),
        )


def _characters(observation: Observation) -> Iterator[Finding]:
    odd = [frame for frame in observation.frames if not _PLAIN.fullmatch(frame)]
    if odd:
        yield Finding(
            code=CODE,
            severity=Severity.NOTE,
            text=f"{len(odd)} names hold blanks or other characters that tools trip over: {quoted(odd)}",
            fix=f"Letters, digits and '_' are safe: {re.sub(r'[^0-9A-Za-z_/]+', '_', odd[0]).strip('_')!r}.",
            frames=frozenset(odd),
        )


def _nearly_the_same(observation: Observation) -> Iterator[Finding]:
    groups: dict[str, list[str]] = {}
    for frame in observation.frames:
        groups.setdefault(re.sub(r"[ _.-]", "", frame).lower(), []).append(frame)
    for names in groups.values():
        if len(names) > 1:
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"names that differ in case, blanks or dashes only: {quoted(names)}",
                fix=f"If they are meant to be one frame, write {names[0]!r} everywhere.",
                frames=frozenset(names),
            )


def _half_a_prefix(observation: Observation) -> Iterator[Finding]:
    """A tree whose root, with or without a prefix, is a frame of another tree."""
    if len(observation.trees) < 2:
        return
    for prefixed in observation.frames:
        for plain in _without_prefixes(prefixed):
            roots = observation.roots.get(prefixed), observation.roots.get(plain)
            if roots[1] is not None and roots[0] != roots[1] and {prefixed, plain} & set(roots):
                prefix = prefixed.removesuffix(plain)
                yield Finding(
                    code=CODE,
                    severity=Severity.WARNING,
                    text=f"half a prefix: {prefixed!r} and {plain!r} are in two trees",
                    fix=f"Give all publishers of the robot the prefix (robot_state_publisher: frame_prefix:={prefix}; "
                    f"odometry: base_frame_id:={prefixed}), or none.",
                    frames=frozenset({prefixed, plain}),
                )
                return


def _without_prefixes(frame: str) -> Iterator[str]:
    """``a/b/c`` as ``b/c`` and ``c``."""
    for _ in range(_LEVELS):
        _, slash, frame = frame.partition("/")
        if not slash:
            return
        yield frame
