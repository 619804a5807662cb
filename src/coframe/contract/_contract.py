# SPDX-License-Identifier: Apache-2.0
"""Contract: the requirements that every good recording of a robot meets."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from coframe.contract._quantities import DEFAULT_TOLERANCE
from coframe.doctor import Severity

__all__ = [
    "AvailabilityRequirement",
    "Contract",
    "IgnoredCode",
    "TopicRequirement",
    "TransformRequirement",
]

Clock = Literal["wall", "simulated", "any"]


@dataclass(frozen=True)
class TransformRequirement:
    """The transforms of one edge.

    Attributes:
        parent: The parent frame.
        child: The child frame.
        namespace: The namespace of the topics with its transforms: ``""`` for /tf, ``/robot1`` for /robot1/tf.
        static: Whether it must be published as a static transform.
        xyz: The position in meters, or None if any is accepted.
        rpy: Roll, pitch and yaw in radians, or None if any rotation is accepted.
        tolerance: The largest accepted differences from `xyz` and `rpy`, in meters and radians.
        min_rate: The minimum rate in Hz, from the first transform to the last one, or None for no minimum.
        max_gap: The maximum time between two transforms, and from the last one to the end, in nanoseconds.
    """

    parent: str
    child: str
    namespace: str = ""
    static: bool = False
    xyz: tuple[float, float, float] | None = None
    rpy: tuple[float, float, float] | None = None
    tolerance: tuple[float, float] = DEFAULT_TOLERANCE
    min_rate: float | None = None
    max_gap: int | None = None


@dataclass(frozen=True)
class TopicRequirement:
    """The messages of one topic.

    Attributes:
        name: The name of the topic.
        type: The type of its messages, such as ``sensor_msgs/msg/LaserScan``, or "" for any.
        frame: The frame in the headers of its messages, or "" for any.
        min_rate: The minimum rate in Hz, from the first message to the last one, or None for no minimum.
        max_gap: The maximum time between two messages, and from the last one to the end, in nanoseconds.
        reliable: Whether its publishers must be reliable.
        transient_local: Whether its publishers must be transient local.
    """

    name: str
    type: str = ""
    frame: str = ""
    min_rate: float | None = None
    max_gap: int | None = None
    reliable: bool = False
    transient_local: bool = False


@dataclass(frozen=True)
class AvailabilityRequirement:
    """A transform must be available soon after messages arrive.

    Attributes:
        target: The target frame.
        source: The source frame.
        at: The topic at whose stamps it must be available.
        namespace: The namespace of the topics with its transforms.
        within: The maximum time from the arrival of a message, in nanoseconds.
        share: The minimum share of the messages, from 0 to 1.
    """

    target: str
    source: str
    at: str
    namespace: str = ""
    within: int = 0
    share: float = 1.0


@dataclass(frozen=True)
class IgnoredCode:
    """A code of the doctor whose findings are accepted, and the reason for that."""

    code: str
    reason: str


@dataclass(frozen=True)
class Contract:
    """The requirements that every good recording meets.

    Attributes:
        transforms: The required edges.
        topics: The required topics.
        availability: Transforms that must be available soon after messages arrive.
        clock: The clock of the stamps: ``wall``, ``simulated`` or ``any``.
        other_frames: Whether frames that no requirement names are accepted.
        fail_on: The lowest severity of the doctor's findings that breaks the contract, or None if none does.
        ignore: The codes of the doctor whose findings are accepted.
    """

    transforms: tuple[TransformRequirement, ...] = ()
    topics: tuple[TopicRequirement, ...] = ()
    availability: tuple[AvailabilityRequirement, ...] = ()
    clock: Clock = "any"
    other_frames: bool = True
    fail_on: Severity | None = Severity.WARNING
    ignore: tuple[IgnoredCode, ...] = field(default=())
