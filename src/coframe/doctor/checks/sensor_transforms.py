# SPDX-License-Identifier: Apache-2.0
"""TF014: sensor messages that cannot be transformed, even after a delay."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import count, duration, join_names
from coframe.analysis.missing_edges import BASE_FRAMES, estimator_advice, is_base_frame, is_sensor_frame
from coframe.analysis.similar_frames import similar_frames
from coframe.analysis.static_command import static_command
from coframe.doctor._finding import Finding, Severity
from coframe.doctor._rules import rename_frame, set_static
from coframe.doctor.observation import NEVER
from coframe.time import MILLISECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from coframe.doctor.observation import Observation, Sensor

__all__ = ["CODE", "find"]

CODE = "TF014"
_MAX_WAIT = 200 * MILLISECOND
_MAX_MISSING_SHARE = 0.05
_MIN_MESSAGES = 5
_USUAL_SUFFIXES = ("_link", "_frame", "_footprint")


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per frame that no transform contains, and one per sensor whose transforms are too late."""
    if not observation.edges:
        return
    unknown: dict[str, list[Sensor]] = {}
    for sensor in observation.sensors:
        if sensor.frame not in observation.frames:
            unknown.setdefault(sensor.frame, []).append(sensor)
        elif len(sensor.stamp):
            yield from _late_transforms(observation, sensor)
    for frame, sensors in unknown.items():
        yield _unknown_frame_finding(observation, frame, sensors)


def _unknown_frame_finding(observation: Observation, frame: str, sensors: list[Sensor]) -> Finding:
    similar = similar_frames(frame, observation.frames)
    publishers = tuple(dict.fromkeys(sensor.publisher for sensor in sensors if sensor.publisher))
    messages = sum(len(sensor.stamp) for sensor in sensors)
    repairs = (rename_frame(*_guess_misspelled(observation, frame, similar[0])),) if similar else ()
    return Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"{count(messages, 'message')} of {join_names(sensor.topic for sensor in sensors)} "
        f"{'is' if messages == 1 else 'are'} expressed in frame {frame!r}, but no transform connects {frame!r} to the "
        f"tree" + (f"; did you mean {similar[0]!r}?" if similar else ""),
        fix=_same_name_advice(observation, frame, similar[0])
        if similar
        else _missing_frame_advice(observation, frame, publishers),
        topic=sensors[0].topic,
        frames=frozenset({frame}),
        first_stamp=int(sensors[0].stamp[0]) if len(sensors[0].stamp) else None,
        publishers=publishers,
        repairs=repairs,
        choices=() if similar else _mounts(observation, frame),
    )


def _mounts(observation: Observation, frame: str) -> tuple[str, ...]:
    """Return the form of the rule that mounts a sensor whose frame no transform contains."""
    if not is_sensor_frame(frame):
        return ()
    bases = [name for name in observation.frames if name.rpartition("/")[2] in BASE_FRAMES]
    return (set_static((bases or list(observation.frames) or ["base_link"])[-1], frame),)


def _guess_misspelled(observation: Observation, frame: str, similar_name: str) -> tuple[str, str]:
    """Return which of two names is probably misspelled, and the other one.

    The name of a link in a robot description is right, and then one with a usual ending.
    """
    described = [f'"{frame}"' in text and f'"{similar_name}"' not in text for text in observation.descriptions]
    is_usual = frame.endswith(_USUAL_SUFFIXES) and not similar_name.endswith(_USUAL_SUFFIXES)
    return (similar_name, frame) if is_usual or any(described) else (frame, similar_name)


def _same_name_advice(observation: Observation, frame: str, similar_name: str) -> str:
    """Return advice about a message's frame whose name differs in a few letters from a frame in the tree.

    Either of the two may be misspelled. A name with the usual ending is probably the right one.
    """
    in_messages = f"In the node of the sensor: msg.header.frame_id = {similar_name!r}"
    if _guess_misspelled(observation, frame, similar_name)[0] == frame:
        return in_messages
    nodes = sorted({node for edge in observation.edges if edge.child == similar_name for node in edge.publishers})
    publisher = f" ({join_names(nodes)})" if nodes else ""
    return (
        f"In the publisher of {similar_name!r}{publisher}: child_frame_id = {frame!r}. "
        f"Or, if {similar_name!r} is right, in the "
        f"node of the sensor: msg.header.frame_id = {similar_name!r}"
    )


def _missing_frame_advice(observation: Observation, frame: str, publishers: tuple[str, ...]) -> str:
    """Return advice about a frame that no transform contains. Only sensors can be mounted statically."""
    prefix, slash, name = frame.rpartition("/")
    root = next(iter(observation.trees))
    known = [f"{prefix}{slash}{usual}" for usual in ("map", "odom", *BASE_FRAMES)]
    known = [usual for usual in known if usual in observation.frames]
    bases = [usual for usual in known if is_base_frame(usual)]
    if name in {"odom", "map"}:
        below = [usual for usual in known if usual.rpartition("/")[2] == "odom"] if name == "map" else []
        node = publishers[0] if name == "odom" and len(publishers) == 1 else ""
        return estimator_advice(frame, next(iter([*below, *bases]), f"{prefix}{slash}base_link"), node)
    if name in BASE_FRAMES:
        above = next((usual for usual in reversed(known) if usual not in bases), "")
        return estimator_advice(above, frame) or f"Start the node that publishes the transforms of {frame!r}."
    if is_sensor_frame(frame):
        # The mount is a pose on the robot, not in the world.
        bases = bases or [other for other in observation.frames if is_base_frame(other)]
        command = static_command(bases[-1] if bases else root, frame)
        return (
            f"No node publishes {frame!r}: start the node that does, such as a static broadcaster or "
            f"robot_state_publisher. If there is none, publish the pose of the sensor: `{command}`."
        )
    return (
        f"Start the node that publishes a transform with child_frame_id = {frame!r}, or correct msg.header.frame_id in "
        "the node of these messages."
    )


def _late_transforms(observation: Observation, sensor: Sensor) -> Iterator[Finding]:
    waits = observation.waits(sensor)
    counted = _find_countable(observation, sensor)
    missing = np.flatnonzero(counted & (waits > _MAX_WAIT))
    if np.count_nonzero(counted) < _MIN_MESSAGES or len(missing) <= _MAX_MISSING_SHARE * np.count_nonzero(counted):
        return
    never = int(np.count_nonzero(waits[missing] == NEVER))
    longest = int(waits[missing][waits[missing] != NEVER].max()) if never < len(missing) else None
    root = observation.root(sensor.frame)
    edges = [edge for edge in observation.path(sensor.frame) if not edge.static]
    if any(edge.is_unset for edge in edges):
        return  # the problem is the stamps, which TF008 reports
    slowest = max(edges, key=lambda edge: edge.period)
    yield Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"{len(missing)} of {np.count_nonzero(counted)} messages cannot be transformed from {sensor.frame!r} to "
        f"{root!r} within 200 ms of their arrival"
        + (f", {never} of them never" if never else "")
        + (f"; the others take up to {duration(longest)}" if longest is not None else "")
        + f"; the edge with the lowest rate is {slowest.name}, every {duration(slowest.period)}",
        fix=f"Publish {slowest.name} at a higher rate and without delay. In the consumer, wait for the transform: "
        f"lookup_transform({root!r}, {sensor.frame!r}, msg.header.stamp, timeout=Duration(seconds=1.0)), or use a "
        "tf2_ros.MessageFilter.",
        topic=sensor.topic,
        frames=frozenset({sensor.frame, *slowest.key}),
        first_stamp=int(sensor.stamp[missing[0]]),
        publishers=(sensor.publisher,) if sensor.publisher else (),
    )


def _find_countable(observation: Observation, sensor: Sensor) -> NDArray[np.bool_]:
    """Return which messages arrived after the first transform, and early enough for a later one, (N,)."""
    edges = [edge for edge in observation.path(sensor.frame) if not edge.static]
    if not edges:
        return np.zeros(len(sensor.stamp), dtype=bool)
    begin = max(int(edge.arrived[0]) for edge in edges)
    first = max(int(edge.stamp.min()) for edge in edges)
    early = (sensor.arrived < begin) | ((sensor.stamp < first) & (sensor.stamp > first - observation.cache))
    return np.asarray(~early & (sensor.arrived < observation.end - _MAX_WAIT))
