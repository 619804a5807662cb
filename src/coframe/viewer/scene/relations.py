# SPDX-License-Identifier: Apache-2.0
"""The pose of one frame relative to another in all common notations, or the reason why there is none."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.analysis.static_command import static_command
from coframe.analysis.tree import FrameTrees
from coframe.errors import TransformException
from coframe.viewer.protocol.server_messages import Relation

if TYPE_CHECKING:
    from coframe.buffer.buffer import Buffer

__all__ = ["relate"]


def relate(buffer: Buffer, target: str, source: str, stamp: int, origin: int, number: int = 0) -> Relation:
    """Return the pose of `source` relative to `target`.

    Args:
        buffer: The buffer that contains both frames.
        target: The frame in which the pose is expressed.
        source: The frame.
        stamp: The time in nanoseconds; 0 selects the latest.
        origin: The origin of the stamp in the result, in nanoseconds.
        number: The id of the request.
    """
    relation = Relation(
        type="relation",
        id=number,
        ok=False,
        target=target,
        source=source,
        stamp=None,
        translation=None,
        quaternion=None,
        rpy_deg=None,
        matrix=None,
        static_command=None,
        chain=[],
        error=None,
        hint=None,
        broken_at=None,
    )
    try:
        found = buffer.lookup(target, source, stamp)
    except TransformException as error:
        relation["chain"], relation["broken_at"] = _broken_chain(buffer, target, source, error)
        relation["error"], relation["hint"] = str(error), error.hint or None
        return relation
    found_stamp = found.stamp or 0
    relation["ok"] = True
    relation["stamp"] = found_stamp - origin if found_stamp else None
    relation["translation"] = found.translation.tolist()
    relation["quaternion"] = found.quaternion.tolist()
    relation["rpy_deg"] = np.degrees(found.rpy).tolist()
    relation["matrix"] = found.matrix.ravel().tolist()
    relation["static_command"] = static_command(target, source, found.values)
    relation["chain"] = _chain(buffer, target, source, found_stamp)
    return relation


def _chain(buffer: Buffer, target: str, source: str, stamp: int) -> list[str]:
    try:
        return buffer.chain(target, stamp, source, stamp, target)
    except TransformException:  # The data has just been dropped from the buffer.
        return []


def _broken_chain(buffer: Buffer, target: str, source: str, error: TransformException) -> tuple[list[str], str | None]:
    """Return the frames from the source to the target as far as they are connected, and where the chain breaks."""
    trees = FrameTrees.from_parents({info.name: info.parent for info in buffer.frames()})
    chain = trees.chain(source, target)
    if chain is not None:
        return chain, error.edge[1] if error.edge else None
    up = trees.path(source)
    unknown = next((frame for frame in (source, target) if frame not in trees.index), None)
    return [*up, *reversed(trees.path(target))], unknown or up[-1]
