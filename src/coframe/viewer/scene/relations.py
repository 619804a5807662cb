"""How two frames stand to each other, in every notation that people copy; and if they do not, why."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.analysis.static_command import static_command
from coframe.analysis.tree import FrameTrees
from coframe.errors import TransformException

if TYPE_CHECKING:
    from coframe import Buffer

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
        "static_command": static_command(target, source, found.values),
        "chain": _chain(buffer, target, source, when),
        "error": None,
        "hint": None,
        "broken_at": None,
    }


_VALUES = ("stamp", "translation", "quaternion", "rpy_deg", "matrix", "static_command")


def _chain(buffer: Buffer, target: str, source: str, stamp: int) -> list[str]:
    try:
        return buffer.chain(target, stamp, source, stamp, target)
    except TransformException:  # the data of that moment has just gone
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
