"""TF014: sensor messages that no transform can be given for, not even after a while."""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.observation import NEVER
from coframe.doctor.phrases import listed
from coframe.formatting import duration

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from coframe.doctor.observation import Observation, Sensor

__all__ = ["CODE", "find"]

CODE = "TF014"
_MS = 1_000_000
_PATIENCE = 200 * _MS
_TOO_MANY = 0.05
_LEAST = 5


def find(observation: Observation) -> Iterator[Finding]:
    """One finding a frame that nobody tells of, and one a sensor that is late all the same."""
    if not observation.edges:
        return
    unknown: dict[str, list[Sensor]] = {}
    for sensor in observation.sensors:
        if sensor.frame not in observation.frames:
            unknown.setdefault(sensor.frame, []).append(sensor)
        elif len(sensor.stamp):
            yield from _late(observation, sensor)
    for frame, sensors in unknown.items():
        yield _unknown(observation, frame, sensors)


def _unknown(observation: Observation, frame: str, sensors: list[Sensor]) -> Finding:
    close = difflib.get_close_matches(frame, observation.frames, n=1)
    some = next(iter(observation.trees))
    return Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"no transform tells of {frame!r}, in which {sum(len(sensor.stamp) for sensor in sensors)} messages of "
        f"{listed(sensor.topic for sensor in sensors)} are told" + (f"; did you mean {close[0]!r}?" if close else ""),
        fix=f"In the sensor's node: msg.header.frame_id = {close[0]!r}"
        if close
        else f"Tell where the sensor is: coframe static --frame-id {some} --child-frame-id {frame} --x ... --yaw ...",
        topic=sensors[0].topic,
        frames=frozenset({frame}),
        first_stamp=int(sensors[0].stamp[0]) if len(sensors[0].stamp) else None,
        publishers=tuple(dict.fromkeys(sensor.publisher for sensor in sensors if sensor.publisher)),
    )


def _late(observation: Observation, sensor: Sensor) -> Iterator[Finding]:
    waits = observation.waits(sensor)
    counted = _countable(observation, sensor)
    missing = np.flatnonzero(counted & (waits > _PATIENCE))
    if np.count_nonzero(counted) < _LEAST or len(missing) <= _TOO_MANY * np.count_nonzero(counted):
        return
    never = int(np.count_nonzero(waits[missing] == NEVER))
    longest = int(waits[missing][waits[missing] != NEVER].max()) if never < len(missing) else None
    root = observation.root(sensor.frame)
    edges = [edge for edge in observation.path(sensor.frame) if not edge.static]
    slowest = max(edges, key=lambda edge: edge.period)
    yield Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"{len(missing)} of {np.count_nonzero(counted)} messages cannot be transformed from {sensor.frame!r} to "
        f"{root!r} even 200 ms after they came"
        + (f", {never} of them never" if never else "")
        + (f"; the others take up to {duration(longest)}" if longest is not None else "")
        + f"; the rarest link is {slowest.parent} -> {slowest.child}, every {duration(slowest.period)}",
        fix=f"Send {slowest.parent} -> {slowest.child} more often and at once; wait for it in the consumer: "
        f"lookup_transform({root!r}, {sensor.frame!r}, msg.header.stamp, timeout=Duration(seconds=1.0)), or a "
        "tf2_ros.MessageFilter.",
        topic=sensor.topic,
        frames=frozenset({sensor.frame, *slowest.key}),
        first_stamp=int(sensor.stamp[missing[0]]),
        publishers=(sensor.publisher,) if sensor.publisher else (),
    )


def _countable(observation: Observation, sensor: Sensor) -> NDArray[np.bool_]:
    """Whether the link's first transform was there, and whether there was time for the next one."""
    edges = [edge for edge in observation.path(sensor.frame) if not edge.static]
    if not edges:
        return np.zeros(len(sensor.stamp), dtype=bool)
    begun = max(int(edge.arrived[0]) for edge in edges)
    first = max(int(edge.stamp.min()) for edge in edges)
    early = (sensor.arrived < begun) | ((sensor.stamp < first) & (sensor.stamp > first - observation.cache))
    return np.asarray(~early & (sensor.arrived < observation.end - _PATIENCE))
