# SPDX-License-Identifier: Apache-2.0
"""Statistics of each frame, as shown in the rows of the tree: rate, age, publisher."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.time import SECOND
from coframe.viewer.protocol.binary_messages import FrameState
from coframe.viewer.protocol.server_messages import FrameStats

if TYPE_CHECKING:
    from coframe.viewer.protocol.common import FrameActivity
    from coframe.viewer.scene.scene import Scene

__all__ = ["frame_rows"]

_STATES: tuple[FrameActivity, ...] = ("fresh", "stale", "gone")
_FRESH = 0
_NO_INTERVALS = (0.0, 0.0, 0.0)


def frame_rows(scene: Scene, origin: int, timeout: float) -> list[FrameStats]:
    """Return the statistics of all frames, in the order of the scene's structure.

    Args:
        scene: The scene that contains the frames.
        origin: The origin of times, in nanoseconds.
        timeout: The number of seconds for which a frame stays visible after its last sample.
    """
    # Raw tuples, because building the objects of edges() would take longer than everything else here.
    intervals = {frame[0]: times for frame, times, _ in scene.buffer._edge_tuples()}
    states = scene.states_now(timeout)
    ages = scene.ages_now()
    rows = []
    for info, state, age in zip(scene.infos, states.tolist(), ages.tolist(), strict=True):
        moves = bool(info.parent) and not info.static
        mean, _, longest = intervals.get(info.name, _NO_INTERVALS) if moves else _NO_INTERVALS
        rows.append(
            FrameStats(
                rate=_rate(mean, is_silent=state != _FRESH),
                age=round(age, 3) if moves and scene.ages else None,
                last=info.newest - origin if moves else None,
                publisher=info.authority or None,
                samples=info.samples,
                longest_gap=round(longest / SECOND, 6) if longest else None,
                state=_STATES[state] if moves or state >= FrameState.STALE else "static",
            )
        )
    return rows


def _rate(mean: float, *, is_silent: bool) -> float | None:
    """Return the rate in Hz for a mean interval in nanoseconds, None if unknown, and 0 if nothing arrives now."""
    if not mean:
        return None
    return 0.0 if is_silent else round(SECOND / mean, 3)
