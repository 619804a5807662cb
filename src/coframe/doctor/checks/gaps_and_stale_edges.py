# SPDX-License-Identifier: Apache-2.0
"""TF013: edges with a low rate, with gaps, or without recent transforms."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import duration, join_names
from coframe.analysis.liveness import median_interval, stamp_intervals, usual_gap
from coframe.analysis.static_command import static_command
from coframe.doctor._edge import publishers_of
from coframe.doctor._finding import Finding, Severity
from coframe.time import MILLISECOND, SECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF013"
_MAX_PERIOD = 400 * MILLISECOND  # the maximum period of a moving edge without a finding
_MAX_SENSOR_EDGE_PERIOD = (
    110 * MILLISECOND
)  # the same for an edge that sensors with a higher rate need: 10 Hz, and some jitter
_MIN_RATE_RATIO = 2.0  # minimum ratio of the sensor rate to the edge rate; poses of the base concern every sensor
_BASE_FRAMES = {"base_link", "base_footprint"}
_CORRECTED_FRAMES = {"odom"}  # localization intentionally corrects map -> odom at a low rate
_MIN_TRANSFORMS = 5  # minimum number of transforms to judge the rate and gaps
# For these sensors, the robot's poses between two transforms matter.
_SENSOR_TYPES = {
    "sensor_msgs/msg/CameraInfo",
    "sensor_msgs/msg/CompressedImage",
    "sensor_msgs/msg/Image",
    "sensor_msgs/msg/LaserScan",
    "sensor_msgs/msg/MultiEchoLaserScan",
    "sensor_msgs/msg/PointCloud2",
    "sensor_msgs/msg/Range",
}


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per slow edge, or edge slower than its sensors; one for all gaps, one for all stale edges."""
    edges = [edge for edge in observation.dynamic if edge.count >= _MIN_TRANSFORMS and edge.period]
    slow = [edge for edge in edges if edge.period > _MAX_PERIOD]
    gaps = [edge for edge in edges if int(edge.intervals.max()) > usual_gap(edge.period)]
    stale = [edge for edge in observation.dynamic if observation.is_stale(edge)]
    yield from map(_slow_edge, slow)
    yield from _edges_slower_than_sensors(
        observation, [edge for edge in edges if edge.period <= _MAX_PERIOD and not edge.is_unset]
    )
    if gaps:
        yield _gap_finding(gaps)
    if stale:
        yield _stale_finding(observation, stale)


def _slow_edge(edge: Edge) -> Finding:
    command = static_command(*edge.key, edge.values[-1].tolist())
    return _make_finding(
        [edge],
        Severity.NOTE if edge.constant else Severity.WARNING,
        f"published only every {duration(edge.period)}; a lookup at now() has to wait that long, or fails",
        "Publish the transform at 10 Hz or more"
        + (
            f"; because the transform never changes, publish it once as static: `{command}`."
            if edge.constant
            else ": self.create_timer(0.02, self.broadcast)."
        ),
        edge.first_stamp,
    )


def _edges_slower_than_sensors(observation: Observation, edges: list[Edge]) -> Iterator[Finding]:
    """Yield edges below 10 Hz that messages with a higher rate need."""
    edges = [edge for edge in edges if edge.period > _MAX_SENSOR_EDGE_PERIOD and not edge.constant]
    edges = [edge for edge in edges if edge.child.rpartition("/")[2] not in _CORRECTED_FRAMES]
    if not edges:
        return
    users = [
        (
            median_interval(stamp_intervals(sensor.stamp[sensor.stamp != 0])),
            sensor.topic,
            observation.path(sensor.frame),
        )
        for sensor in observation.sensors
        if len(sensor.stamp) >= _MIN_TRANSFORMS and sensor.type in _SENSOR_TYPES
    ]
    for edge in edges:
        factor = 1.1 if edge.child.rpartition("/")[2] in _BASE_FRAMES else _MIN_RATE_RATIO
        faster = [
            (period, topic) for period, topic, path in users if 0 < period * factor < edge.period and edge in path
        ]
        if faster:
            yield _edge_slower_than_sensor(edge, *min(faster))


def _edge_slower_than_sensor(edge: Edge, period: float, topic: str) -> Finding:
    rate, sensor_rate = SECOND / edge.period, SECOND / period
    return _make_finding(
        [edge],
        Severity.WARNING,
        f"published every {duration(edge.period)} ({rate:.3g} Hz), but {topic}, which needs it, every "
        f"{duration(period)} ({sensor_rate:.3g} Hz): its messages wait up to {duration(edge.period)} for the next "
        "transform, and their poses are interpolated",
        "Publish the transform at 20 Hz or more, ideally at the rate of the sensor: "
        f"self.create_timer({min(0.05, period / SECOND):.3g}, self.broadcast), or raise the rate in the parameters of "
        "the node (publish_rate, frequency).",
        edge.first_stamp,
    )


def _gap_finding(edges: list[Edge]) -> Finding:
    worst = max(edges, key=lambda edge: int(edge.intervals.max()))
    row = int(np.argmax(worst.intervals))
    return _make_finding(
        edges,
        Severity.WARNING,
        f"a gap of {duration(int(worst.intervals.max()))}; the usual period is {duration(worst.period)}"
        f"{_edges_text(edges)}; tf2 interpolates across the gap",
        "Find out what delayed the publisher: a blocking callback (time.sleep, a service call), an overloaded "
        "processor, or a lossy network. Give the timer of the publisher its own callback group "
        "(MultiThreadedExecutor).",
        int(np.unique(worst.stamp)[row]),
    )


def _stale_finding(observation: Observation, edges: list[Edge]) -> Finding:
    worst = max(edges, key=observation.silence)
    usual = f"; the usual period is {duration(worst.period)}" if worst.period else ""
    publishers = f" ({join_names(worst.publishers)})" if worst.publishers else ""
    return _make_finding(
        edges,
        Severity.WARNING,
        f"stale: no transform for the last {duration(observation.silence(worst))}{usual}{_edges_text(edges)}",
        f"Restart the publisher{publishers}. Until then, lookups at now() fail, and the latest transform is outdated.",
        int(worst.stamp[-1]),
    )


def _edges_text(edges: list[Edge]) -> str:
    return f" (on {len(edges)} edges: {join_names(edge.name for edge in edges)})" if len(edges) > 1 else ""


def _make_finding(edges: list[Edge], severity: Severity, text: str, fix: str, stamp: int) -> Finding:
    return Finding(
        code=CODE,
        severity=severity,
        text=text,
        fix=fix,
        edge=edges[0].key,
        edges=tuple(edge.key for edge in edges),
        frames=frozenset(name for edge in edges for name in edge.key),
        first_stamp=stamp,
        publishers=publishers_of(edges),
    )
