# SPDX-License-Identifier: Apache-2.0
"""TF012: time that jumped back, for example after a recording was restarted or a simulation was reset."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import duration, join_names, times
from coframe.doctor._edge import publishers_of
from coframe.doctor._finding import Finding, Severity
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF012"
_JUMP = -SECOND
# With two publishers on different clocks, time goes back continuously; a reset is rare.
_MAX_JUMP_SHARE = 0.1


def find(observation: Observation) -> Iterator[Finding]:
    """Yield at most one finding, because a reset affects every edge."""
    found = [(edge, jumps) for edge in observation.dynamic if not edge.is_unset and len(jumps := _jumps(edge.stamp))]
    on_clock = _jumps(observation.clock.stamp) if observation.clock is not None else np.zeros(0, dtype=np.intp)
    if not found and not len(on_clock):
        return
    if found:
        edge, jumps = max(found, key=lambda pair: len(pair[1]))
        back, first, count = -int(edge.steps[jumps].min()), int(edge.stamp[jumps[0] + 1]), len(jumps)
    else:
        assert observation.clock is not None
        stamps = observation.clock.stamp
        back, first, count = -int(np.diff(stamps).min()), int(stamps[on_clock[0] + 1]), len(on_clock)
    names = join_names([*(edge.name for edge, _ in found), *(["/clock"] if len(on_clock) else [])])
    yield Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"time jumped back {times(count)}, by up to {duration(back)}, on {names}: listeners clear their buffers, "
        "or reject the following transforms because they are too old",
        fix="Restart the listeners after a simulation was reset or a recording was restarted; replay a recording once, "
        "or with --clock and use_sim_time:=true, so that nodes detect the jump.",
        edge=found[0][0].key if found else None,
        edges=tuple(edge.key for edge, _ in found),
        topic="" if found else "/clock",
        frames=frozenset(name for edge, _ in found for name in edge.key),
        first_stamp=first,
        publishers=publishers_of(edge for edge, _ in found),
    )


def _jumps(stamps: NDArray[np.int64]) -> NDArray[np.intp]:
    """Return the rows after which time goes back and does not return immediately."""
    jumps = np.flatnonzero(np.diff(stamps) < _JUMP)
    if len(jumps) > max(3, _MAX_JUMP_SHARE * len(stamps)):
        return jumps[:0]
    # With two clocks that alternate, the next row is at the later time again.
    last = len(stamps) - 1
    return jumps[stamps[np.minimum(jumps + 2, last)] < stamps[jumps]]
