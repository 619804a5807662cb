# SPDX-License-Identifier: Apache-2.0
"""Compare measurements with the requirements of a contract."""

from __future__ import annotations

import math
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe._output.formatting import count, did_you_mean, duration, join_names
from coframe.contract._measurement import pace_of
from coframe.doctor import diagnose
from coframe.quaternion import from_rpy, inverse, multiply, to_rotvec

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.contract._contract import (
        AvailabilityRequirement,
        Contract,
        TopicRequirement,
        TransformRequirement,
    )
    from coframe.contract._measurement import MeasuredTopic, Measurement, Pace
    from coframe.doctor.observation import Edge, Observation

__all__ = ["Result", "check_contract"]


class Result(NamedTuple):
    """The result of one requirement.

    Attributes:
        kind: ``transform``, ``topic``, ``availability``, ``clock``, ``frames`` or ``finding``.
        subject: What the requirement is about, such as ``odom -> base_link`` or ``/scan``.
        problems: What is required and what is there instead, one sentence each; empty if the requirement is met.
        unchecked: What could not be checked, and why, one sentence each.
    """

    kind: str
    subject: str
    problems: tuple[str, ...]
    unchecked: tuple[str, ...] = ()

    @property
    def is_met(self) -> bool:
        """Whether the requirement is met."""
        return not self.problems


def check_contract(contract: Contract, measurement: Measurement) -> list[Result]:
    """Return the result of each requirement, in the order of the contract."""
    return [
        *(_transform(each, measurement) for each in contract.transforms),
        *(_topic(each, measurement) for each in contract.topics),
        *(_availability(each, measurement) for each in contract.availability),
        *_clock(contract, measurement),
        *_frames(contract, measurement),
        *_findings(contract, measurement),
    ]


def _transform(requirement: TransformRequirement, measurement: Measurement) -> Result:
    subject = f"{requirement.namespace}: " if requirement.namespace else ""
    subject += f"{requirement.parent} -> {requirement.child}"
    return Result("transform", subject, tuple(_transform_problems(requirement, measurement)))


def _transform_problems(requirement: TransformRequirement, measurement: Measurement) -> Iterator[str]:
    observation = measurement.observations.get(requirement.namespace)
    edge = None if observation is None else observation.last.get(requirement.child)
    if observation is None or edge is None:
        known = [] if observation is None else observation.frames
        yield f"the frame {requirement.child!r} was not published. {did_you_mean(requirement.child, known)}".rstrip(
            ". "
        )
        return
    if edge.parent != requirement.parent:
        yield f"the parent of {requirement.child!r} is {edge.parent!r}, not {requirement.parent!r}"
    if requirement.static and not edge.static:
        yield "it was published as a dynamic transform, not as a static one"
    if edge.static and not requirement.static and requirement.min_rate:
        yield "it was published as a static transform, not as a dynamic one"
        return
    yield from _pose_problems(requirement, edge)
    yield from _pace_problems(
        requirement.min_rate, requirement.max_gap, pace_of(np.sort(edge.arrived), observation.end)
    )


def _pose_problems(requirement: TransformRequirement, edge: Edge) -> Iterator[str]:
    poses = edge.poses(np.arange(edge.count))
    meters, radians = requirement.tolerance
    if requirement.xyz is not None:
        distance = float(np.linalg.norm(poses[:, :3] - np.array(requirement.xyz), axis=1).max())
        if not distance <= meters:
            yield f"the position is off by {_length(distance)}; the tolerance is {_length(meters)}"
    if requirement.rpy is not None:
        turns = multiply(inverse(from_rpy(np.array(requirement.rpy))), poses[:, 3:])
        distance = float(np.linalg.norm(to_rotvec(turns), axis=1).max())
        if not distance <= radians:
            yield f"the rotation is off by {_angle(distance)}; the tolerance is {_angle(radians)}"


def _topic(requirement: TopicRequirement, measurement: Measurement) -> Result:
    topic = measurement.topics.get(requirement.name)
    unchecked = () if topic is None else tuple(_unchecked_requirements(requirement, topic, measurement))
    return Result("topic", requirement.name, tuple(_topic_problems(requirement, measurement)), unchecked)


def _topic_problems(requirement: TopicRequirement, measurement: Measurement) -> Iterator[str]:
    topic = measurement.topics.get(requirement.name)
    if topic is None:
        yield f"there is no such topic. {did_you_mean(requirement.name, measurement.topics)}".rstrip(". ")
        return
    if not topic.pace.messages:
        yield "it has no messages"
        return
    if requirement.type and topic.type != requirement.type:
        yield f"its type is {topic.type}, not {requirement.type}"
    frames = _frames_of(requirement.name, measurement)
    if requirement.frame and frames is not None and frames != [requirement.frame]:
        yield f"its messages are in {join_names(frames) or 'no frame'}, not in {requirement.frame}"
    yield from _pace_problems(requirement.min_rate, requirement.max_gap, topic.pace)
    if requirement.reliable and topic.reliable is False:
        yield "a publisher is best effort, not reliable"
    if requirement.transient_local and topic.transient_local is False:
        yield "a publisher is volatile, not transient local: late subscriptions receive nothing"


def _frames_of(topic: str, measurement: Measurement) -> list[str] | None:
    """Return the frames of the messages on a topic, or None if they are unknown."""
    sensors = [each for one in measurement.observations.values() for each in one.sensors]
    if frames := sorted({each.frame for each in sensors if each.topic == topic}):
        return frames
    frame = measurement.topics[topic].frame
    return None if frame is None else [frame] if frame else []


def _unchecked_requirements(
    requirement: TopicRequirement, topic: MeasuredTopic, measurement: Measurement
) -> Iterator[str]:
    """Yield what is required of a topic but unknown."""
    unknown_qos = [
        name
        for name, is_required, offered in (
            ("reliable", requirement.reliable, topic.reliable),
            ("transient_local", requirement.transient_local, topic.transient_local),
        )
        if is_required and offered is None
    ]
    if unknown_qos:
        yield f"{' and '.join(unknown_qos)}: the QoS of its publishers is unknown"
    if requirement.max_gap is not None and topic.pace.messages and topic.pace.max_gap is None:
        yield "max_gap: the times of its messages are unknown"
    if requirement.frame and topic.pace.messages and _frames_of(requirement.name, measurement) is None:
        yield "frame: the frames of its messages are unknown"


def _pace_problems(min_rate: float | None, max_gap: int | None, pace: Pace) -> Iterator[str]:
    if min_rate is not None and (pace.rate is None or pace.rate < min_rate):
        there = count(pace.messages, "message") if pace.rate is None else f"the rate is {pace.rate:.3g} Hz"
        yield f"{there}; the minimum is {min_rate:g} Hz"
    if max_gap is not None and pace.max_gap is not None and pace.max_gap > max_gap:
        yield f"the longest gap is {duration(pace.max_gap)}; the maximum is {duration(max_gap)}"


def _availability(requirement: AvailabilityRequirement, measurement: Measurement) -> Result:
    subject = f"{requirement.namespace}: " if requirement.namespace else ""
    subject += f"{requirement.target} <- {requirement.source} at {requirement.at}"
    return Result("availability", subject, tuple(_availability_problems(requirement, measurement)))


def _availability_problems(requirement: AvailabilityRequirement, measurement: Measurement) -> Iterator[str]:
    observation = measurement.observations.get(requirement.namespace)
    sensors = [] if observation is None else [each for each in observation.sensors if each.topic == requirement.at]
    if observation is None or not sensors:
        yield f"no message on {requirement.at} has a stamp"
        return
    for frame in (requirement.target, requirement.source):
        if frame not in observation.frames:
            yield f"the frame {frame!r} was not published. {did_you_mean(frame, observation.frames)}".rstrip(". ")
            return
    if observation.structure.chain(requirement.target, requirement.source) is None:
        yield f"{requirement.target!r} and {requirement.source!r} are in different trees"
        return
    share = _share(requirement, observation)
    if share < requirement.share:
        yield (
            f"it was available within {duration(requirement.within)} for {_percent(share)} of the messages; "
            "the minimum "
            f"is {_percent(requirement.share)}"
        )


def _share(requirement: AvailabilityRequirement, observation: Observation) -> float:
    waits = [
        observation.waits_between(requirement.target, requirement.source, each.stamp, each.arrived)
        for each in observation.sensors
        if each.topic == requirement.at
    ]
    return float(np.mean(np.concatenate(waits) <= requirement.within))


def _clock(contract: Contract, measurement: Measurement) -> Iterator[Result]:
    if contract.clock == "any":
        return
    for name, observation in measurement.observations.items():
        found = observation.usual_clock
        problem = f"the stamps are {_clock_words(found)}, not {_clock_words(contract.clock)}"
        yield Result("clock", f"stamps of {name or '/'}", (problem,) if found != contract.clock else ())


def _clock_words(clock: str) -> str:
    words = {"wall": "system time", "simulated": "simulated time", "": "unknown, because there are none"}
    return words.get(clock, "of a clock that is far from the system time")


def _frames(contract: Contract, measurement: Measurement) -> Iterator[Result]:
    if contract.other_frames:
        return
    required_frames: dict[str, set[str]] = {}
    for each in contract.transforms:
        required_frames.setdefault(each.namespace, set()).update((each.parent, each.child))
    for name, observation in measurement.observations.items():
        others = sorted(set(observation.frames) - required_frames.get(name, set()))
        problem = f"the contract does not name {count(len(others), 'frame')}: {join_names(others)}"
        yield Result("frames", f"other frames of {name or '/'}", (problem,) if others else ())


def _findings(contract: Contract, measurement: Measurement) -> Iterator[Result]:
    if contract.fail_on is None:
        return
    ignored = {each.code for each in contract.ignore}
    reports = (diagnose(observation, ignore=ignored) for observation in measurement.observations.values())
    found: dict[str, list[str]] = {}
    for finding in chain.from_iterable(report.every_finding() for report in reports):
        if finding.severity >= contract.fail_on:
            subject = f"{finding.subject}: " if finding.subject else ""
            found.setdefault(finding.code, []).append(f"{subject}{finding.text}")
    for code in sorted(found):
        yield Result("finding", code, tuple(found[code]))
    if not found:
        yield Result("finding", "doctor", ())


def _length(meters: float) -> str:
    return f"{meters * 1e3:.3g} mm" if meters < 1 else f"{meters:.3g} m"


def _angle(radians: float) -> str:
    return f"{math.degrees(radians):.3g} degrees"


def _percent(share: float) -> str:
    """Return a percentage; rounded down, so that a share below a minimum never looks equal to it."""
    return f"{math.floor(share * 1e4) / 1e2:g} %"
