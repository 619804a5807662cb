# SPDX-License-Identifier: Apache-2.0
"""Static transforms, 20 points: the mounts of the sensors, sent once, so that late listeners receive them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.course._sheet import Sheet
from coframe.course.criteria.causes import edge_cause, pose_cause, quaternion_values
from coframe.course.criteria.common import (
    TOLERANCE,
    Task,
    difference_text,
    norm_of,
    read_edge,
    run_program,
    transforms_on_tf,
)
from coframe.course.rubric import RUBRIC
from coframe.transform.transform import Transform
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from tf2_msgs.msg import TFMessage

if TYPE_CHECKING:
    from coframe.course._world import Received
    from coframe.course.assignment import Mount

__all__ = ["check"]

_TOPIC = "/tf_static"
_WRONG_BROADCASTER = (
    "TransformBroadcaster sends on /tf, where late-joining listeners miss it: use StaticTransformBroadcaster"
)
_OWN_PUBLISHER = "the publisher of /tf_static has other QoS: use StaticTransformBroadcaster"
_LATE_JOINER_TIME = 3.0  # seconds of real time in which a late listener receives stored transforms
_READ = "handbook chapter 3, static and dynamic transforms"


class _Sent:
    """The transforms that the program has sent, by child frame.

    Attributes:
        static: Those on /tf_static.
        dynamic: Those on /tf.
        late: Those on /tf_static that a late listener received.
        messages: The frames of each message on /tf_static.
    """

    def __init__(self, static: list[Received], dynamic_messages: list[Received], late_messages: list[Received]) -> None:
        self.static, self.dynamic, self.late = (
            _group_by_child(each) for each in (static, dynamic_messages, late_messages)
        )
        self.messages = [{each.child_frame_id for each in one.message.transforms} for one in static]

    def last(self, frame: str) -> Any:
        """Return the last transform to a frame, or None."""
        found = self.static.get(frame) or self.dynamic.get(frame)
        return found[-1] if found else None

    def edges(self) -> list[tuple[str, str]]:
        """Return the parent and child of each transform."""
        sent = (each for group in (self.static, self.dynamic) for messages in group.values() for each in messages)
        return [(each.header.frame_id, each.child_frame_id) for each in sent]


def check(task: Task) -> Sheet:
    """Check ``static_tf_broadcaster.py``."""
    sheet = Sheet.of(RUBRIC["static"])
    world = task.world
    with run_program(task, sheet, outputs=["/tf"]) as program:
        static = world.watch(_TOPIC, TFMessage, latched=True)
        dynamic = world.watch("/tf", TFMessage), world.watch("/tf", TFMessage, latched=True)
        if program is not None:
            world.start(program)
            world.run(5.0)
        late = world.watch(_TOPIC, TFMessage, latched=True)
        if program is not None:
            frames = {mount.frame for mount in task.assignment.mounts}
            world.wait_until(lambda: frames <= _group_by_child(late).keys(), _LATE_JOINER_TIME)
            world.run(0.3)
        sent = _Sent(static, transforms_on_tf(*dynamic), late)
        for mount in task.assignment.mounts:
            _check_mount(sheet, task, mount, sent)
        _check_delivery(sheet, task, sent)
    return sheet


def _group_by_child(messages: list[Received]) -> dict[str, list[Any]]:
    found: dict[str, list[Any]] = {}
    for each in messages:
        for message in each.message.transforms:
            found.setdefault(message.child_frame_id, []).append(message)
    return found


def _check_mount(sheet: Sheet, task: Task, mount: Mount, sent_transforms: _Sent) -> None:
    known = {"base_link", "end_effector", *(each.frame for each in task.assignment.mounts)}
    message = sent_transforms.last(mount.frame)
    cause = edge_cause(mount.parent, mount.frame, sent_transforms.edges(), known)
    others = ", ".join(
        f"{parent} -> {child}" for parent, child in dict.fromkeys(sent_transforms.edges()) if child not in known
    )
    sheet.check(
        1,
        f"{mount.frame} has the parent {mount.parent}",
        message is not None and message.header.frame_id == mount.parent,
        expected=f"a transform from {mount.parent} to {mount.frame}",
        observed=f"the parent is {message.header.frame_id!r}"
        if message is not None
        else f"no transform to {mount.frame}" + (f"; received: {others}" if others else ""),
        cause=cause,
        read=_READ,
    )
    correct = Transform(mount.translation, mount.quaternion)
    length = 1.0 if message is None else norm_of(message.transform.rotation)
    wrong = "" if message is None else difference_text(read_edge(message), correct)
    sheet.check(
        3,
        f"{mount.frame} is at the correct position",
        0.0 if message is None or wrong or not length else 1.0 if abs(length - 1.0) <= TOLERANCE else 2 / 3,
        expected=f"position {list(mount.translation)} m, rotation {_round_values(mount.quaternion)} (x, y, z, w)",
        observed=f"no transform to {mount.frame}"
        if message is None
        else f"the quaternion is {_round_values(quaternion_values(message.transform.rotation).tolist())}"
        if not length
        else wrong or f"the quaternion has the length {length:.6f} instead of 1",
        cause=cause if message is None else pose_cause(read_edge(message), message.transform.rotation, correct),
        read="handbook chapter 2, rotations and quaternions",
    )


def _round_values(values: tuple[float, ...] | list[float]) -> list[float]:
    return [round(value, 7) for value in values]


def _check_delivery(sheet: Sheet, task: Task, sent_transforms: _Sent) -> None:
    expected_frames = [mount.frame for mount in task.assignment.mounts]
    # Only frames that were sent: a wrong name has lost its points already.
    frames = [frame for frame in expected_frames if sent_transforms.last(frame) is not None] or expected_frames
    on_static = [frame for frame in frames if frame in sent_transforms.static and frame not in sent_transforms.dynamic]
    on_tf = [frame for frame in frames if frame in sent_transforms.dynamic]
    wrong_topic = _WRONG_BROADCASTER if on_tf else ""
    sheet.check(
        2,
        "the transforms are on /tf_static",
        len(on_static) / len(frames),
        expected="all on /tf_static, none on /tf",
        observed=f"{len(on_static)} of {len(frames)} on /tf_static, {len(on_tf)} on /tf",
        cause=wrong_topic,
        read=_READ,
    )
    offers = [info.qos_profile for info in task.world.publishers_of(_TOPIC)]
    durable = [
        qos.durability == DurabilityPolicy.TRANSIENT_LOCAL and qos.reliability == ReliabilityPolicy.RELIABLE
        for qos in offers
    ]
    sheet.check(
        2,
        "the publisher is reliable and transient local",
        bool(durable) and all(durable),
        expected="reliable, transient local",
        observed=", ".join(f"{qos.reliability.name}, {qos.durability.name}" for qos in offers) or "no publisher",
        cause=_OWN_PUBLISHER if offers else wrong_topic,
        read=_READ,
    )
    reached = [frame for frame in frames if frame in sent_transforms.late]
    is_durable = bool(durable) and all(durable)
    sheet.check(
        2,
        "a listener that joins 5 s later receives the transforms",
        len(reached) / len(frames),
        expected="all transforms",
        observed=f"{len(reached)} of {len(frames)}: {', '.join(reached) or 'none'}",
        cause=_OWN_PUBLISHER if offers and not is_durable else wrong_topic,
        read=_READ,
    )
    in_one_call = any(set(frames) <= message for message in sent_transforms.messages) or (
        not sent_transforms.static and bool(on_tf)
    )
    largest = max(map(len, sent_transforms.messages), default=0)
    sheet.check(
        1,
        "the transforms are sent in one call",
        in_one_call,
        expected="one sendTransform call with a list of all transforms",
        observed=f"{len(sent_transforms.messages)} calls with at most {largest} transforms"
        if sent_transforms.messages
        else "no call",
        cause="sendTransform is called for each transform: late listeners of ROS 2 Humble receive only the last call. "
        "Send one list"
        if len(sent_transforms.messages) > 1
        else "",
        read=_READ,
    )
    most = max(
        (len(sent_transforms.static.get(frame) or sent_transforms.dynamic.get(frame) or []) for frame in frames),
        default=0,
    )
    sheet.check(
        1,
        "the transforms are sent once",
        most == 1,
        expected="each transform is sent once",
        observed=f"sent {most} times in 5 s",
        cause="sendTransform is called repeatedly, as in a timer: the middleware stores static transforms"
        if most > 1
        else "",
        read=_READ,
    )
