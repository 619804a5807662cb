"""How often each frame is told of, by whom, and how long ago: what a row of the tree says."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.viewer.scene.scene import STALE

if TYPE_CHECKING:
    from coframe.viewer.scene.scene import Scene

__all__ = ["frame_rows"]

_NS = 1e9
_STATES = ("fresh", "stale", "gone")
_NO_INTERVALS = (0.0, 0.0, 0.0)


def frame_rows(scene: Scene, origin: int, timeout: float) -> list[dict[str, Any]]:
    """One row a frame, in the order of the scene's structure."""
    # What edges() makes of it would take longer than the rest.
    intervals = {frame[0]: times for frame, times, _ in scene.buffer._edge_tuples()}
    states = scene.states_now(timeout)
    ages = scene.ages_now()
    rows = []
    for info, state, age in zip(scene.infos, states.tolist(), ages.tolist(), strict=True):
        moves = bool(info.parent) and not info.static
        mean, _, longest = intervals.get(info.name, _NO_INTERVALS) if moves else _NO_INTERVALS
        rows.append(
            {
                "rate": round(_NS / mean, 3) if mean else None,
                "age": round(age, 3) if moves and scene.ages else None,
                "last": info.newest - origin if moves else None,
                "publisher": info.authority or None,
                "samples": info.samples,
                "longest_gap": round(longest / _NS, 6) if longest else None,
                "state": _STATES[state] if moves or state >= STALE else "static",
            }
        )
    return rows
