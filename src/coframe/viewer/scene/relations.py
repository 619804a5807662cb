"""How two frames stand to each other, in every notation that people copy; and if they do not, why."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.errors import TransformException

if TYPE_CHECKING:
    from coframe import Buffer, Transform

__all__ = ["relate"]


def relate(buffer: Buffer, target: str, source: str, stamp: int, origin: int) -> dict[str, Any]:
    """The fields of a ``relation``: where ``source`` is, seen from ``target``, at a time; 0 is the latest."""
    names = {"target": target, "source": source}
    try:
        found = buffer.lookup(target, source, stamp)
    except TransformException as error:
        chain, broken_at = _broken_chain(buffer, target, source, error)
        why = {"error": str(error), "hint": error.hint or None, "broken_at": broken_at, "chain": chain}
        return {"ok": False, **names, **dict.fromkeys(_VALUES), **why}
    when = found.stamp or 0
    return {
        "ok": True,
        **names,
        "stamp": when - origin if when else None,
        "translation": found.translation.tolist(),
        "quaternion": found.quaternion.tolist(),
        "rpy_deg": np.degrees(found.rpy).tolist(),
        "matrix": found.matrix.ravel().tolist(),
        "static_command": static_command(found),
        "chain": _chain(buffer, target, source, when),
        "error": None,
        "hint": None,
        "broken_at": None,
    }


_VALUES = ("stamp", "translation", "quaternion", "rpy_deg", "matrix", "static_command")


def static_command(transform: Transform) -> str:
    """The command that publishes a transform, as a shell takes it."""
    names = ("x", "y", "z", "qx", "qy", "qz", "qw")
    numbers = " ".join(f"--{name}={value:.9g}" for name, value in zip(names, transform.values, strict=True))
    parent, child = shlex.quote(f"--frame-id={transform.target}"), shlex.quote(f"--child-frame-id={transform.source}")
    return f"coframe static {numbers} {parent} {child}"


def _chain(buffer: Buffer, target: str, source: str, stamp: int) -> list[str]:
    try:
        return buffer.chain(target, stamp, source, stamp, target)
    except TransformException:  # the data of that moment has just gone
        return []


def _broken_chain(buffer: Buffer, target: str, source: str, error: TransformException) -> tuple[list[str], str | None]:
    """The frames from the source up and down again to the target as far as they are known, and where it breaks."""
    parents = {info.name: info.parent for info in buffer.frames()}
    up, down = _way_up(source, parents), _way_up(target, parents)
    meeting = next((frame for frame in up if frame in down), None)
    if meeting is None:
        broken_at = source if source not in parents else target if target not in parents else up[-1]
        return up + down[::-1], broken_at
    chain = [*up[: up.index(meeting) + 1], *reversed(down[: down.index(meeting)])]
    return chain, error.edge[1] if error.edge else None


def _way_up(frame: str, parents: dict[str, str]) -> list[str]:
    way = [frame]
    seen = {frame}
    while (parent := parents.get(way[-1])) and parent not in seen:
        way.append(parent)
        seen.add(parent)
    return way
