"""TF004: loops, frames that are their own parent, empty names, messages without a transform."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.phrases import quoted, times

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF004"
_LONGEST = 20  # names of a loop that are told


def find(observation: Observation) -> Iterator[Finding]:
    """Loops, then what tf2 refuses, then empty messages."""
    yield from _loops(observation)
    yield from _refused(observation)
    if observation.damaged_messages:
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{observation.damaged_messages} messages hold bytes that are no TFMessage",
            fix="Find the program that writes its own bytes on the topic, or copy the recording again.",
            harm="Listeners throw such a message away: what it was to tell is not there.",
        )
    if observation.messages_left_out:
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{observation.messages_left_out} messages were not looked at: there are too many names of frames",
            fix="Find the publisher that numbers its frames without end; what is said here holds for the time before.",
            harm="Every buffer that listens grows with each new name, for as long as it lives.",
        )
    if observation.empty_messages:
        yield Finding(
            code=CODE,
            severity=Severity.NOTE,
            text=f"a message without any transform was sent {times(observation.empty_messages)}",
            fix="Harmless; in its publisher: `if transforms: broadcaster.sendTransform(transforms)`.",
            harm="It tells nobody anything; listeners take it and go on.",
        )


def _loops(observation: Observation) -> Iterator[Finding]:
    for root in observation.trees:
        loop = observation.path(root)  # a root has no parent, unless it is in a loop
        if not loop:
            continue
        names = [loop[-1].parent, *(edge.child for edge in reversed(loop))]
        way = " -> ".join(names if len(names) <= _LONGEST else [*names[:_LONGEST], f"and {len(loop) - _LONGEST} more"])
        yield Finding(
            code=CODE,
            severity=Severity.ERROR,
            text=f"the frames go round in a loop: {way}",
            fix=f"Take one of these transforms away, or turn it round; the last one was {loop[0].parent} -> "
            f"{loop[0].child}: swap its t.header.frame_id and t.child_frame_id.",
            frames=frozenset(edge.child for edge in loop),
            edge=loop[0].key,
            first_stamp=max(edge.first_stamp for edge in loop),
            publishers=tuple(dict.fromkeys(name for edge in loop for name in edge.publishers)),
        )


def _refused(observation: Observation) -> Iterator[Finding]:
    told = observation.transforms
    for link in range(len(told.links)):
        parent, child = told.pair(link)
        if parent.lstrip("/") == child.lstrip("/"):
            wrong = "is its own parent" if child.lstrip("/") else "has neither a parent's nor a child's name"
        elif not parent.lstrip("/") or not child.lstrip("/"):
            wrong = "has no parent's name" if not parent.lstrip("/") else "has no name"
        else:
            continue
        rows = np.flatnonzero(told.link == link)
        yield Finding(
            code=CODE,
            severity=Severity.ERROR,
            text=f"{quoted([child])} {wrong}, told {times(len(rows))}: tf2 refuses it",
            fix="Set both names before sending: t.header.frame_id = 'PARENT', t.child_frame_id = 'CHILD'.",
            frames=frozenset({parent.lstrip("/"), child.lstrip("/")} - {""}),
            first_stamp=int(told.stamp[rows[0]]),
            publishers=told.senders(rows),
        )
