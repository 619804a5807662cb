"""TF015: sensor messages that come when a buffer has forgotten their time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.formatting import duration

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF015"
_LEAST = 3


def find(observation: Observation) -> Iterator[Finding]:
    """One finding a sensor."""
    for sensor in observation.sensors:
        moving = [edge for edge in observation.path(sensor.frame) if not edge.static]
        behind = np.zeros(len(sensor.stamp), dtype=np.int64)
        for edge in moving:
            # What the buffer had when the message came.
            newest = np.maximum.accumulate(edge.stamp)
            row = np.searchsorted(edge.arrived, sensor.arrived, side="right") - 1
            behind = np.maximum(behind, np.where(row >= 0, newest[np.maximum(row, 0)] - sensor.stamp, 0))
        late = np.flatnonzero((behind > observation.cache) & (sensor.stamp != 0))
        if len(late) < _LEAST or f"{sensor.topic}" not in observation.clocks:
            continue
        if any(observation.clocks[f"{e.parent} -> {e.child}"] != observation.clocks[sensor.topic] for e in moving):
            continue  # no buffer is long enough for another clock
        need = int(np.ceil(behind.max() / 1e9)) + 1
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{len(late)} of {len(sensor.stamp)} messages come up to {duration(int(behind.max()))} after their "
            f"stamps, when a buffer of {duration(observation.cache)} has forgotten them",
            fix=f"Keep more: tf2_ros.Buffer(cache_time=Duration(seconds={need})), coframe.Buffer(cache='{need}s'); or "
            "make the sensor's processing quicker.",
            topic=sensor.topic,
            frames=frozenset({sensor.frame}),
            first_stamp=int(sensor.stamp[late[0]]),
            publishers=(sensor.publisher,) if sensor.publisher else (),
        )
