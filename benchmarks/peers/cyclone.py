# SPDX-License-Identifier: Apache-2.0
"""The messages of benchmarks.publishing as classes of the cyclonedds package, whose own codec serializes them."""

# mypy: disable-error-code="type-arg, arg-type"
# The stubs of cyclonedds do not know that a sequence has a type and can be made from a list.

from dataclasses import dataclass, field
from typing import Any

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import float64, int32, sequence, uint8, uint32
from cyclonedds.topic import Topic
from cyclonedds.util import duration

from benchmarks.publishing import CLOUD_SIZE

QOS = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepLast(10))


@dataclass
class Time(IdlStruct, typename="Time"):
    sec: int32 = 0
    nanosec: uint32 = 0


@dataclass
class Header(IdlStruct, typename="Header"):
    stamp: Time = field(default_factory=Time)
    frame_id: str = ""


@dataclass
class Vector3(IdlStruct, typename="Vector3"):
    x: float64 = 0.0
    y: float64 = 0.0
    z: float64 = 0.0


@dataclass
class Quaternion(IdlStruct, typename="Quaternion"):
    x: float64 = 0.0
    y: float64 = 0.0
    z: float64 = 0.0
    w: float64 = 1.0


@dataclass
class Transform(IdlStruct, typename="Transform"):
    translation: Vector3 = field(default_factory=Vector3)
    rotation: Quaternion = field(default_factory=Quaternion)


@dataclass
class TransformStamped(IdlStruct, typename="TransformStamped"):
    header: Header
    child_frame_id: str
    transform: Transform = field(default_factory=Transform)


@dataclass
class TFMessage(IdlStruct, typename="TFMessage"):
    transforms: sequence[TransformStamped]


@dataclass
class JointState(IdlStruct, typename="JointState"):
    name: sequence[str]
    position: sequence[float64]
    velocity: sequence[float64]
    effort: sequence[float64]
    header: Header = field(default_factory=Header)


@dataclass
class PointCloud2(IdlStruct, typename="PointCloud2"):
    data: sequence[uint8]
    header: Header = field(default_factory=Header)
    height: uint32 = 1
    width: uint32 = CLOUD_SIZE // 16


TYPES: dict[str, type[IdlStruct]] = {"tf": TFMessage, "joints": JointState, "cloud": PointCloud2}


def topic(participant: DomainParticipant, kind: str) -> Any:
    return Topic(participant, f"benchmark_{kind}", TYPES[kind])


def message(kind: str) -> IdlStruct:
    if kind == "tf":
        return TFMessage([TransformStamped(Header(frame_id="odom"), "base_link")])
    if kind == "joints":
        names = [f"arm_joint_{number}" for number in range(30)]
        return JointState(names, [0.5] * 30, [0.1] * 30, [2.0] * 30)
    return PointCloud2(bytearray(CLOUD_SIZE))
