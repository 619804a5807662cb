# SPDX-License-Identifier: Apache-2.0
"""TF028: sensor topics with the messages of two sources."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import count, join_names
from coframe.doctor._finding import Finding, Severity

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from coframe.doctor.observation import Observation, ObservedPositions, Sensor

__all__ = ["CODE", "find"]

CODE = "TF028"
_MIN_CHANGES = 5  # from one source to another
_MIN_SHARE = 0.05  # of the messages that follow a message of another source
_MIN_TRACKED = 20  # successive positions
_MIN_DISTANCE_RATIO = 10  # times the usual step: the distance between two sources
_MIN_DISTANCE = 0.05  # meters
_ONE_SOURCE = {
    *(f"sensor_msgs/msg/{name}" for name in ("CameraInfo", "CompressedImage", "FluidPressure", "Image", "Imu")),
    *(f"sensor_msgs/msg/{name}" for name in ("LaserScan", "MagneticField", "MultiEchoLaserScan", "NavSatFix")),
    *(f"sensor_msgs/msg/{name}" for name in ("PointCloud2", "PointCloud")),
    *(f"nav_msgs/msg/{name}" for name in ("OccupancyGrid", "Odometry", "Path")),
    *(f"geometry_msgs/msg/{name}" for name in ("AccelStamped", "PoseStamped", "PoseWithCovarianceStamped")),
    *(f"geometry_msgs/msg/{name}" for name in ("TwistStamped", "TwistWithCovarianceStamped", "WrenchStamped")),
}
_FIX = (
    "Give each source its own topic: remap it in one of the launch files, or start each robot in a namespace. "
    "Recordings of two robots: `coframe bag merge A B --prefix robot1/ --prefix robot2/`."
)


def find(observation: Observation) -> Iterator[Finding]:
    """Yield a finding for each topic whose messages alternate between frames, nodes or places.

    Topics of other types, such as markers, detections, joint states and logs, have several sources by design.
    """
    topics: dict[str, list[Sensor]] = {}
    for sensor in observation.sensors:
        if sensor.type in _ONE_SOURCE and len(sensor.stamp):
            topics.setdefault(sensor.topic, []).append(sensor)
    found = set()
    for topic, sensors in topics.items():
        nodes = tuple(dict.fromkeys(node for sensor in sensors for node in sensor.publishers))
        if _do_alternate(sensors, [np.full(len(sensor.stamp), number) for number, sensor in enumerate(sensors)]):
            found.add(topic)
            names = join_names(f"{sensor.frame!r} ({count(len(sensor.stamp), 'message')})" for sensor in sensors)
            drops = tuple(f"drop-publisher {topic}@{sensor.frame}" for sensor in sensors)
            yield _make_finding(topic, f"the messages alternate between {len(sensors)} frames: {names}", nodes, drops)
        elif len(nodes) > 1 and _do_alternate(sensors, [_nodes(sensor, nodes) for sensor in sensors]):
            found.add(topic)
            yield _make_finding(
                topic, f"the messages alternate between {len(nodes)} publishers: {join_names(nodes)}", nodes
            )
    for one in observation.positions:
        if one.topic not in found and (distance := _distance(one)):
            text = f"the positions jump back and forth between two tracks, {distance:.3g} m apart"
            yield _make_finding(one.topic, text)


def _nodes(sensor: Sensor, nodes: tuple[str, ...]) -> NDArray[np.int64]:
    """Return the number of the node of each message. For an unknown node, repeat the previous number."""
    numbers = np.array([nodes.index(node) for node in sensor.publishers], dtype=np.int64)
    known = np.maximum.accumulate(np.where(sensor.source < 0, 0, np.arange(len(sensor.source))))
    return numbers[np.maximum(sensor.source[known], 0)]


def _do_alternate(sensors: list[Sensor], sources: list[NDArray[np.int64]]) -> bool:
    """Return whether the sources of the messages change again and again."""
    order = np.argsort(np.concatenate([sensor.arrived for sensor in sensors]), kind="stable")
    changes = np.count_nonzero(np.diff(np.concatenate(sources)[order]))
    return bool(changes >= max(_MIN_CHANGES, _MIN_SHARE * len(order)))


def _distance(positions: ObservedPositions) -> float:
    """Return how far apart two tracks are between which the positions jump, or 0 if they are one track."""
    return max((_track_distance(part) for part in positions.parts if len(part) >= _MIN_TRACKED), default=0.0)


def _track_distance(points: NDArray[np.float64]) -> float:
    """Return how far apart two tracks are between which successive positions jump, or 0 if they are one track."""
    farthest = int(np.argmax(np.linalg.norm(points[: _MIN_TRACKED // 2] - points[0], axis=1)))
    ends = [points[0], points[farthest]]
    steps: tuple[list[float], list[float]] = [], []
    apart: list[float] = []
    track = changes = 0
    for point in points:
        near = [float(np.linalg.norm(point - end)) for end in ends]
        nearest = int(near[1] < near[0])
        steps[nearest].append(near[nearest])
        apart.append(near[1 - nearest])
        changes += nearest != track
        track, ends[nearest] = nearest, point
    if min(map(len, steps)) < _MIN_CHANGES or changes < max(_MIN_CHANGES, _MIN_SHARE * len(points)):
        return 0.0
    step = max(float(np.median(each)) for each in steps)
    distance = float(np.median(apart))
    return distance if distance > max(_MIN_DISTANCE_RATIO * step, _MIN_DISTANCE) else 0.0


def _make_finding(topic: str, text: str, publishers: tuple[str, ...] = (), choices: tuple[str, ...] = ()) -> Finding:
    return Finding(
        code=CODE, severity=Severity.WARNING, text=f"{text}: the topic may have two sources", fix=_FIX, topic=topic,
        publishers=publishers, choices=choices,
    )  # fmt: skip
