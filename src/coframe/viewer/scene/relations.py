"""The pose of one frame relative to another in all common notations, or the reason why there is none."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING

import numpy as np

from coframe.errors import TransformException
from coframe.viewer.protocol.messages import Relation

if TYPE_CHECKING:
    from coframe import Buffer, Transform

__all__ = ["relate"]


def relate(buffer: Buffer, target: str, source: str, stamp: int, origin: int, number: int = 0) -> Relation:
    """Return the pose of `source` relative to `target`.

    Args:
        buffer: The buffer.
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
    relation["static_command"] = static_command(found)
    relation["chain"] = _chain(buffer, target, source, found_stamp)
    return relation


def static_command(transform: Transform) -> str:
    """Return the shell command that publishes a transform."""
    names = ("x", "y", "z", "qx", "qy", "qz", "qw")
    numbers = " ".join(f"--{name}={value:.9g}" for name, value in zip(names, transform.values, strict=True))
    parent, child = shlex.quote(f"--frame-id={transform.target}"), shlex.quote(f"--child-frame-id={transform.source}")
    return f"coframe static {numbers} {parent} {child}"


def _chain(buffer: Buffer, target: str, source: str, stamp: int) -> list[str]:
    try:
        return buffer.chain(target, stamp, source, stamp, target)
    except TransformException:  # The data has just been dropped.
        return []


def _broken_chain(buffer: Buffer, target: str, source: str, error: TransformException) -> tuple[list[str], str | None]:
    """Return the known frames from the source to the target, and the frame where the chain is broken."""
    parents = {info.name: info.parent for info in buffer.frames()}
    up, down = _ancestors(source, parents), _ancestors(target, parents)
    meeting = next((frame for frame in up if frame in down), None)
    if meeting is None:
        broken_at = source if source not in parents else target if target not in parents else up[-1]
        return up + down[::-1], broken_at
    chain = [*up[: up.index(meeting) + 1], *reversed(down[: down.index(meeting)])]
    return chain, error.edge[1] if error.edge else None


def _ancestors(frame: str, parents: dict[str, str]) -> list[str]:
    """Return a frame and its ancestors; the list ends before a frame repeats."""
    chain = [frame]
    seen = {frame}
    while (parent := parents.get(chain[-1])) and parent not in seen:
        chain.append(parent)
        seen.add(parent)
    return chain
