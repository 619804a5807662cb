"""TF012: time that went back: a recording that began anew, a simulation that was reset."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.phrases import listed, times
from coframe.formatting import duration

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF012"
_JUMP = -1_000_000_000
# Who sends by turns with another clock goes back all the time; a reset is rare.
_RARE = 0.1


def find(observation: Observation) -> Iterator[Finding]:
    """One finding in all: a reset shows on every link."""
    found = [(edge, jumps) for edge in observation.dynamic if len(jumps := _jumps(edge.stamp))]
    ticks = _jumps(observation.clock.stamp) if observation.clock is not None else np.zeros(0, dtype=np.intp)
    if not found and not len(ticks):
        return
    if found:
        edge, jumps = max(found, key=lambda pair: len(pair[1]))
        back, first, count = -int(edge.steps[jumps].min()), int(edge.stamp[jumps[0] + 1]), len(jumps)
    else:
        assert observation.clock is not None
        stamps = observation.clock.stamp
        back, first, count = -int(np.diff(stamps).min()), int(stamps[ticks[0] + 1]), len(ticks)
    where = listed([*(f"{edge.parent} -> {edge.child}" for edge, _ in found), *(["/clock"] if len(ticks) else [])])
    yield Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"time jumped back {times(count)}, by up to {duration(back)}, on {where}: listeners clear their buffers "
        "then, or refuse what comes as too old",
        fix="Restart the listeners after a simulation was reset or a recording looped; play it once, or with "
        "--clock and use_sim_time:=true, so that nodes notice.",
        edge=found[0][0].key if found else None,
        topic="" if found else "/clock",
        frames=frozenset(name for edge, _ in found for name in edge.key),
        first_stamp=first,
        publishers=tuple(dict.fromkeys(name for edge, _ in found for name in edge.publishers)),
    )


def _jumps(stamps: NDArray[np.int64]) -> NDArray[np.intp]:
    """The rows after which time goes back and does not come back at once."""
    jumps = np.flatnonzero(np.diff(stamps) < _JUMP)
    if len(jumps) > max(3, _RARE * len(stamps)):
        return jumps[:0]
    # Two clocks by turns: the next row is at the old time again.
    last = len(stamps) - 1
    return jumps[stamps[np.minimum(jumps + 2, last)] < stamps[jumps]]
