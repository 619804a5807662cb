"""TF011: stamps that come twice, and transforms that are too old to be taken."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.formatting import duration

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.edge import Edge
    from coframe.doctor.observation import JointStates, Observation

__all__ = ["CODE", "find"]

CODE = "TF011"
_LEAST = 3


def find(observation: Observation) -> Iterator[Finding]:
    """Per link, repetitions and old data; per topic of joint states, repetitions."""
    for edge in observation.dynamic:
        yield from _repeated(edge.current)
        yield from _old(edge, observation.cache)
    for states in observation.joint_states:
        yield from _repeated_states(states)


def _repeated(edge: Edge) -> Iterator[Finding]:
    order = np.argsort(edge.stamp, kind="stable")
    again = np.flatnonzero(np.diff(edge.stamp[order]) == 0)
    if len(again) < _LEAST:
        return
    differ = int(np.count_nonzero((edge.values[order[again]] != edge.values[order[again + 1]]).any(axis=1)))
    yield Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"{len(again)} of {edge.count} transforms repeat a stamp, {differ} of them with another pose",
        fix="Send each transform once: let the timer be no faster than what is measured, and stamp with the "
        "measurement's "
        "time; `if stamp > self.last_stamp: self.broadcaster.sendTransform(t)`.",
        edge=edge.key,
        first_stamp=int(edge.stamp[order[again[0]]]),
        publishers=edge.publishers,
    )


def _old(edge: Edge, cache: int) -> Iterator[Finding]:
    behind = np.maximum.accumulate(edge.stamp) - edge.stamp
    old = np.flatnonzero(behind > cache)
    if len(old):
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{len(old)} of {edge.count} transforms are older than the newest one by more than a buffer of "
            f"{duration(cache)} keeps: by up to {duration(int(behind.max()))}",
            fix="Restart the listeners after a clock or a recording has begun anew, or find the second publisher whose "
            "clock is behind.",
            edge=edge.key,
            first_stamp=int(edge.stamp[old[0]]),
            publishers=edge.publishers,
        )


def _repeated_states(states: JointStates) -> Iterator[Finding]:
    order = np.argsort(states.stamp, kind="stable")
    again = np.flatnonzero(np.diff(states.stamp[order]) == 0)
    if len(again) < _LEAST:
        return
    before, after = order[again], order[again + 1]
    differ = np.zeros(len(again), dtype=bool)
    for positions in states.positions.values():
        differ |= positions[before] != positions[after]
    yield Finding(
        code=CODE,
        severity=Severity.NOTE,
        text=f"{len(again)} of {len(states.stamp)} joint states repeat a stamp, {np.count_nonzero(differ)} of "
        "them with "
        "other positions",
        fix="Stamp each joint state when its joints are read; robot_state_publisher leaves repetitions out.",
        harm="One time has two positions of a joint: which of them a program takes is chance.",
        topic=states.topic,
        first_stamp=int(states.stamp[order[again[0]]]),
    )
