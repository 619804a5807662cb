"""How often each frame is told of, by whom, and how long ago: what a row of the tree says."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.viewer.scene import STALE

if TYPE_CHECKING:
    from coframe.viewer.scene import Scene

__all__ = ["frame_rows"]

_NS = 1e9
_STATES = ("fresh", "stale", "gone")


def frame_rows(scene: Scene, origin: int, timeout: float) -> list[dict[str, Any]]:
    """One row a frame, in the order of the scene's structure."""
    edges = {edge.child: edge for edge in scene.buffer.edges(now=0)}
    states = scene.states_now(timeout)
    ages = scene.ages_now() if scene.ages else np.full(len(states), np.nan)
    rows = []
    for info, state, age in zip(scene.infos, states.tolist(), ages.tolist(), strict=True):
        moves = bool(info.parent) and not info.static
        edge = edges.get(info.name)
        told = moves and edge is not None
        rows.append(
            {
                "rate": round(edge.rate, 3) if told and edge and edge.rate else None,
                "age": round(age, 3) if moves and age == age else None,  # noqa: PLR0124 - not NaN
                "last": info.newest - origin if moves else None,
                "publisher": info.authority or None,
                "samples": info.samples,
                "longest_gap": round(edge.longest_gap / _NS, 6) if told and edge and edge.samples > 1 else None,
                "state": _STATES[state] if moves or state >= STALE else "static",
            }
        )
    return rows
