# SPDX-License-Identifier: Apache-2.0
"""TF011: repeated stamps, and transforms older than the cache length."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import duration
from coframe.doctor._finding import Finding, Severity
from coframe.doctor._rules import drop_tracks

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation, ObservedJointStates

__all__ = ["CODE", "find"]

CODE = "TF011"
_MIN_REPETITIONS = 3


def find(observation: Observation) -> Iterator[Finding]:
    """Yield repetitions and old data per edge, and repetitions per topic of joint states."""
    for edge in observation.dynamic:
        if edge.is_unset:
            continue
        yield from _repeated_stamps(edge.current)
        yield from _old_transforms(edge, observation.cache)
    for states in observation.joint_states:
        yield from _repeated_states(states)


def _repeated_stamps(edge: Edge) -> Iterator[Finding]:
    order = np.argsort(edge.stamp, kind="stable")
    repeated = np.flatnonzero(np.diff(edge.stamp[order]) == 0)
    if len(repeated) < _MIN_REPETITIONS:
        return
    first, second = edge.values[order[repeated]], edge.values[order[repeated + 1]]
    differ = int(np.count_nonzero((first != second).any(axis=1)))
    yield Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"{len(repeated)} of {edge.count} transforms repeat a stamp, {differ} of them with another pose",
        fix="Publish each transform once: run the timer no faster than the measurement, and use the stamp of the "
        "measurement: `if stamp > self.last_stamp: self.broadcaster.sendTransform(t)`.",
        edge=edge.key,
        first_stamp=int(edge.stamp[order[repeated[0]]]),
        publishers=edge.publishers,
        repairs=() if differ else ("dedupe",),
        choices=drop_tracks(edge.key) if differ else (),
    )


def _old_transforms(edge: Edge, cache: int) -> Iterator[Finding]:
    behind = np.maximum.accumulate(edge.stamp) - edge.stamp
    old = np.flatnonzero(behind > cache)
    if len(old):
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{len(old)} of {edge.count} transforms are older than the cache length of {duration(cache)}: up to "
            f"{duration(int(behind.max()))} older than the newest one",
            fix="Restart the listeners after a clock was reset or a recording was restarted, or find the second "
            "publisher whose clock is behind.",
            edge=edge.key,
            first_stamp=int(edge.stamp[old[0]]),
            publishers=edge.publishers,
        )


def _repeated_states(states: ObservedJointStates) -> Iterator[Finding]:
    order = np.argsort(states.stamp, kind="stable")
    repeated = np.flatnonzero(np.diff(states.stamp[order]) == 0)
    if len(repeated) < _MIN_REPETITIONS:
        return
    before, after = order[repeated], order[repeated + 1]
    differ = np.zeros(len(repeated), dtype=bool)
    for positions in states.positions.values():
        differ |= positions[before] != positions[after]
    yield Finding(
        code=CODE,
        severity=Severity.NOTE,
        text=f"{len(repeated)} of {len(states.stamp)} joint states repeat a stamp, {np.count_nonzero(differ)} of them "
        "with other positions",
        fix="Stamp each joint state when the joints are read; robot_state_publisher skips repeated stamps.",
        harm="The joint then has two positions at one time, and it is undefined which one a program uses.",
        topic=states.topic,
        first_stamp=int(states.stamp[order[repeated[0]]]),
    )
