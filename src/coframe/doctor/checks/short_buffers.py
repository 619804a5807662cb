# SPDX-License-Identifier: Apache-2.0
"""TF015: sensor messages that arrive after the buffer has dropped the transforms of their time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import duration
from coframe.doctor._finding import Finding, Severity
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF015"
_MIN_TRANSFORMS = 3


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per sensor."""
    for sensor in observation.sensors:
        moving_edges = [edge for edge in observation.path(sensor.frame) if not edge.static]
        behind = np.zeros(len(sensor.stamp), dtype=np.int64)
        for edge in moving_edges:
            # The newest stamp in the buffer when the message arrived.
            newest = np.maximum.accumulate(edge.stamp)
            row = np.searchsorted(edge.arrived, sensor.arrived, side="right") - 1
            behind = np.maximum(behind, np.where(row >= 0, newest[np.maximum(row, 0)] - sensor.stamp, 0))
        late = np.flatnonzero((behind > observation.cache) & (sensor.stamp != 0))
        if len(late) < _MIN_TRANSFORMS or sensor.topic not in observation.clocks:
            continue
        if any(observation.clocks.get(edge.name) != observation.clocks[sensor.topic] for edge in moving_edges):
            continue  # with stamps from another clock, no cache is long enough
        need = int(np.ceil(behind.max() / SECOND)) + 1
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{len(late)} of {len(sensor.stamp)} messages arrive up to {duration(int(behind.max()))} after their "
            f"stamps, but a buffer stores transforms for only {duration(observation.cache)}",
            fix=f"Use a longer cache: tf2_ros.Buffer(cache_time=Duration(seconds={need})) or "
            f"coframe.Buffer(cache='{need}s'); or reduce the processing time of the sensor data.",
            topic=sensor.topic,
            frames=frozenset({sensor.frame}),
            first_stamp=int(sensor.stamp[late[0]]),
            publishers=(sensor.publisher,) if sensor.publisher else (),
        )
