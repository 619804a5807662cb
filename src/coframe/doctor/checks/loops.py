# SPDX-License-Identifier: Apache-2.0
"""TF004: loops, frames that are their own parent, empty frame names, invalid and empty messages."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import join_quoted, times
from coframe.doctor._edge import publishers_of
from coframe.doctor._finding import Finding, Severity
from coframe.doctor._rules import drop_edge

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF004"
_MAX_NAMES = 20  # maximum number of frames of a loop to list in a finding


def find(observation: Observation) -> Iterator[Finding]:
    """Yield the loops, then the transforms that tf2 rejects, then damaged and empty messages."""
    yield from _loops(observation)
    yield from _rejected_transforms(observation)
    if observation.damaged_messages:
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{observation.damaged_messages} messages are not valid TFMessages",
            fix="Find the program that publishes these bytes on the topic. If the recording is damaged, copy it again.",
            harm="Listeners discard such messages, and the transforms in them are lost.",
        )
    if observation.empty_messages:
        yield Finding(
            code=CODE,
            severity=Severity.NOTE,
            text=f"a message without transforms was published {times(observation.empty_messages)}",
            fix="Empty messages are harmless. To avoid them: `if transforms: broadcaster.sendTransform(transforms)`.",
            harm="Listeners process the message for nothing.",
        )


def _loops(observation: Observation) -> Iterator[Finding]:
    structure = observation.structure
    for number in sorted(structure.loops):
        loop = observation.path(structure.names[structure.roots[number]])
        names = [loop[-1].parent, *(edge.child for edge in reversed(loop))]
        more = [f"and {len(loop) - _MAX_NAMES} more"] if len(names) > _MAX_NAMES else []
        yield Finding(
            code=CODE,
            severity=Severity.ERROR,
            text=f"the frames form a loop: {' -> '.join([*names[:_MAX_NAMES], *more])}",
            fix=f"Remove one of these transforms, or invert it. For {loop[0].name}: swap its t.header.frame_id and "
            "t.child_frame_id, and invert the pose.",
            frames=frozenset(edge.child for edge in loop),
            edge=loop[0].key,
            first_stamp=max(edge.first_stamp for edge in loop),
            publishers=publishers_of(loop),
            choices=tuple(drop_edge(edge.key) for edge in loop[:_MAX_NAMES]),
        )


def _rejected_transforms(observation: Observation) -> Iterator[Finding]:
    transforms = observation.transforms
    for number in range(len(transforms.pairs)):
        parent, child = transforms.pair(number)
        if parent.lstrip("/") == child.lstrip("/"):
            problem = "is its own parent" if child.lstrip("/") else "has an empty parent name and an empty child name"
        elif not parent.lstrip("/") or not child.lstrip("/"):
            problem = "has an empty parent name" if not parent.lstrip("/") else "is an empty frame name"
        else:
            continue
        rows = np.flatnonzero(transforms.edge == number)
        yield Finding(
            code=CODE,
            severity=Severity.ERROR,
            text=f"{join_quoted([child])} {problem}, published {times(len(rows))}; tf2 ignores the transform",
            fix="Set both names before publishing: t.header.frame_id = 'PARENT', t.child_frame_id = 'CHILD'.",
            frames=frozenset({parent.lstrip("/"), child.lstrip("/")} - {""}),
            first_stamp=int(transforms.stamp[rows[0]]),
            publishers=transforms.publishers_of(rows),
            repairs=("drop-invalid",),
        )
