"""TF004: loops, frames that are their own parent, empty names, messages without a transform."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.wording import quoted, times

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF004"


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
    if observation.empty_messages:
        yield Finding(
            code=CODE,
            severity=Severity.NOTE,
            text=f"a message without any transform was sent {times(observation.empty_messages)}",
            fix="Harmless; in its publisher: `if transforms: broadcaster.sendTransform(transforms)`.",
            harm="It tells nobody anything; listeners take it and go on.",
        )


def _loops(observation: Observation) -> Iterator[Finding]:
    told: set[frozenset[str]] = set()
    for frame in observation.frames:
        path = observation.path(frame)
        if not path or path[-1].parent not in {edge.child for edge in path}:
            continue
        # The part of the way that comes back to itself.
        start = [edge.child for edge in path].index(path[-1].parent)
        loop = path[start:]
        members = frozenset(edge.child for edge in loop)
        if members in told:
            continue
        told.add(members)
        way = " -> ".join([loop[-1].parent, *(edge.child for edge in reversed(loop))])
        yield Finding(
            code=CODE,
            severity=Severity.ERROR,
            text=f"the frames go round in a loop: {way}",
            fix=f"Take one of these transforms away, or turn it round; the last one was {loop[0].parent} -> "
            f"{loop[0].child}: swap its t.header.frame_id and t.child_frame_id.",
            frames=members,
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
