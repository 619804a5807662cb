# SPDX-License-Identifier: Apache-2.0
"""The changes from one forest to the next."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from coframe._output.escaping import display_name
from coframe._output.formatting import duration

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.tree_drawing._forest import Forest, Frame

__all__ = ["Change", "changes"]


class Change(NamedTuple):
    """A change of one frame.

    Attributes:
        kind: ``new``, ``gone``, ``moved`` (it has another parent), ``stale``, or ``resumed`` (it is published
            again).
        frame: The name of the frame.
        text: A description without a period.
    """

    kind: str
    frame: str
    text: str


def changes(before: Forest, after: Forest) -> Iterator[Change]:
    """Yield the new, changed and removed frames, in drawing order."""
    for name, frame in after.frames.items():
        old = before.frames.get(name)
        if old is None:
            yield Change("new", name, f"{display_name(name)} is new: {_position(frame)}")
        elif old.parent != frame.parent:
            yield Change(
                "moved", name, f"{display_name(name)} moved: now {_position(frame)}, previously {_position(old)}"
            )
        elif frame.silence is not None and old.silence is None:
            yield Change("stale", name, f"{display_name(name)} is stale: no transform for {duration(frame.silence)}")
        elif frame.silence is None and old.silence is not None:
            yield Change("resumed", name, f"{display_name(name)} is published again")
    for name, old in before.frames.items():
        if name not in after.frames:
            yield Change("gone", name, f"{display_name(name)} is gone; it was {_position(old)}")


def _position(frame: Frame) -> str:
    return f"below {display_name(frame.parent)}" if frame.parent else "a root"
