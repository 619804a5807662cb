# SPDX-License-Identifier: Apache-2.0
"""Derive a contract from a good recording, with margins for differences between recordings of one robot."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from coframe.contract._contract import (
    AvailabilityRequirement,
    Contract,
    IgnoredCode,
    TopicRequirement,
    TransformRequirement,
)
from coframe.contract._measurement import pace_of
from coframe.contract._quantities import DEFAULT_TOLERANCE
from coframe.doctor import Severity, diagnose
from coframe.quaternion import to_rpy
from coframe.time import MILLISECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.contract._contract import Clock
    from coframe.contract._measurement import MeasuredTopic, Measurement, Pace
    from coframe.doctor.observation import Edge, Observation

__all__ = ["derive_contract"]

_RATE_MARGIN = 0.8  # of the measured rate
_GAP_MARGIN = 1.5  # times the longest gap, and at least three times the median
_MIN_MESSAGES = 10  # fewer have no rate
_MAX_IRREGULARITY = 10  # the longest gap over the median gap; what is less regular has no required rate
_WAIT_TIMES = (20 * MILLISECOND, 50 * MILLISECOND, 100 * MILLISECOND, 200 * MILLISECOND)
_SHARE, _MIN_SHARE = 0.99, 0.5
# Topics of the tools themselves, which say nothing about the robot, and the topics of transforms.
_UNRELATED_TOPICS = ("/rosout", "/parameter_events", "/events/write_split", "/bond", "/diagnostics_agg")


def derive_contract(measurement: Measurement, *, fail_on: Severity | None = Severity.WARNING) -> Contract:
    """Return a contract that the measured recording satisfies.

    Rates have a margin of 20 %, gaps of 50 %. What was published irregularly, such as goals, has no rate. The findings
    of the doctor in the recording are accepted, and their texts are the reasons.

    Args:
        measurement: What the recording contains.
        fail_on: The lowest severity of findings that breaks the contract.
    """
    observations = measurement.observations
    return Contract(
        transforms=tuple(
            _transform(observation, edge, namespace)
            for namespace, observation in observations.items()
            for edge in observation.last.values()
        ),
        topics=tuple(
            _topic(topic, measurement)
            for name, topic in sorted(measurement.topics.items())
            if topic.pace.messages
            and name not in _UNRELATED_TOPICS
            and not name.rstrip("c").endswith(("/tf", "/tf_stati"))
        ),
        availability=tuple(each for name, one in observations.items() for each in _availability(one, name)),
        clock=_clock(list(observations.values())),
        fail_on=fail_on,
        ignore=tuple(_accepted_codes(observations, fail_on)),
    )


def _transform(observation: Observation, edge: Edge, namespace: str) -> TransformRequirement:
    if edge.static:
        x, y, z = edge.last_pose[0, :3].tolist()
        roll, pitch, yaw = to_rpy(edge.last_pose[0, 3:]).tolist()
        return TransformRequirement(
            edge.parent, edge.child, namespace, True, (x, y, z), (roll, pitch, yaw), DEFAULT_TOLERANCE
        )
    rate, gap = _limits(pace_of(np.sort(edge.arrived), observation.end))
    return TransformRequirement(edge.parent, edge.child, namespace, min_rate=rate, max_gap=gap)


def _topic(topic: MeasuredTopic, measurement: Measurement) -> TopicRequirement:
    frames = {s.frame for one in measurement.observations.values() for s in one.sensors if s.topic == topic.name}
    rate, gap = _limits(topic.pace)
    return TopicRequirement(
        topic.name,
        topic.type,
        frames.pop() if len(frames) == 1 else "",
        rate,
        gap,
        topic.reliable is True,
        topic.transient_local is True,
    )


def _limits(pace: Pace) -> tuple[float | None, int | None]:
    """Return the required rate and the accepted gap, or None for what is published irregularly."""
    if pace.messages < _MIN_MESSAGES or pace.rate is None or pace.max_gap is None or not pace.median:
        return None, None
    if pace.max_gap > _MAX_IRREGULARITY * pace.median:
        return None, None
    gap = max(_GAP_MARGIN * pace.max_gap, 3 * pace.median)
    return -_rounded_up(-pace.rate * _RATE_MARGIN), int(_rounded_up(gap))


def _rounded_up(value: float) -> float:
    """Return a value with two significant digits, rounded up."""
    scale = 10.0 ** (1 - math.floor(math.log10(abs(value))))
    return round(math.ceil(value * scale) / scale, 9)


def _availability(observation: Observation, namespace: str) -> Iterator[AvailabilityRequirement]:
    """Yield a requirement for each topic of sensor data: from its frame to the root of the tree."""
    for sensor in observation.sensors:
        root = observation.root(sensor.frame)
        if sensor.frame == root or not len(sensor.stamp):
            continue
        waits = observation.waits_between(root, sensor.frame, sensor.stamp, sensor.arrived)
        shares = [float(np.mean(waits <= within)) for within in _WAIT_TIMES]
        within, share = next(
            pair for pair in zip(_WAIT_TIMES, shares, strict=True) if pair[1] >= min(_SHARE, max(shares))
        )
        if share >= _MIN_SHARE:
            share = _SHARE if share >= _SHARE else math.floor(share * 98) / 100
            yield AvailabilityRequirement(root, sensor.frame, sensor.topic, namespace, within, share)


def _clock(observations: list[Observation]) -> Clock:
    clocks = {observation.usual_clock for observation in observations}
    return "wall" if clocks == {"wall"} else "simulated" if clocks == {"simulated"} else "any"


def _accepted_codes(observations: dict[str, Observation], fail_on: Severity | None) -> Iterator[IgnoredCode]:
    seen: set[str] = set()
    for observation in observations.values():
        for finding in diagnose(observation).every_finding():
            if fail_on is not None and finding.severity >= fail_on and finding.code not in seen:
                seen.add(finding.code)
                subject = f"{finding.subject}: " if finding.subject else ""
                yield IgnoredCode(finding.code, f"in the good recording: {subject}{finding.text}"[:300])
