# SPDX-License-Identifier: Apache-2.0
"""Static transforms, 20 points: the mounts of the sensors, sent once, so that late listeners receive them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.course._sheet import Sheet
from coframe.course.criteria.common import TOLERANCE, Task, difference_text, read_edge, run_program
from coframe.course.rubric import RUBRIC
from coframe.transform.transform import Transform
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from tf2_msgs.msg import TFMessage

if TYPE_CHECKING:
    from coframe.course._world import Received
    from coframe.course.assignment import Mount

__all__ = ["check"]

_TOPIC = "/tf_static"
_NOT_UNIT_CAUSE = "0.707 is not the square root of one half: use math.sqrt(0.5)"
_WRONG_BROADCASTER_CAUSE = (
    "TransformBroadcaster sends on /tf, where late-joining listeners miss it: use StaticTransformBroadcaster"
)
_LATE_JOINER_TIME = 3.0  # seconds of real time in which a late listener receives stored transforms
_READ = "handbook chapter 3, static and dynamic transforms"


def check(task: Task) -> Sheet:
    """Check ``static_tf_broadcaster.py``."""
    sheet = Sheet.of(RUBRIC["static"])
    world = task.world
    with run_program(task, sheet, wrong_topic="/tf") as program:
        static = world.watch(_TOPIC, TFMessage, latched=True)
        dynamic = world.watch("/tf", TFMessage)
        if program is not None:
            world.start(program)
            world.run(5.0)
        late = world.watch(_TOPIC, TFMessage, latched=True)
        if program is not None:
            frames = {mount.frame for mount in task.assignment.mounts}
            world.wait_until(lambda: frames <= _group_by_child(late).keys(), _LATE_JOINER_TIME)
            world.run(0.3)
        sent, repeated = _group_by_child(static), _find_repeated(_group_by_child(dynamic))
        missing = _WRONG_BROADCASTER_CAUSE if world.publishers_of("/tf") else "a misspelled child_frame_id"
        for mount in task.assignment.mounts:
            _check_mount(sheet, mount, sent.get(mount.frame) or repeated.get(mount.frame, []), missing)
        _check_delivery(sheet, task, sent, repeated, _group_by_child(late))
    return sheet


def _group_by_child(received: list[Received]) -> dict[str, list[Any]]:
    found: dict[str, list[Any]] = {}
    for each in received:
        for message in each.message.transforms:
            found.setdefault(message.child_frame_id, []).append(message)
    return found


def _find_repeated(sent: dict[str, list[Any]]) -> dict[str, list[Any]]:
    """Return the transforms that were sent repeatedly; one sent only once on /tf may or may not arrive."""
    return {child: messages for child, messages in sent.items() if len(messages) > 1}


def _check_mount(sheet: Sheet, mount: Mount, messages: list[Any], missing: str) -> None:
    sheet.check(
        1,
        f"{mount.frame} has the parent {mount.parent}",
        bool(messages) and messages[-1].header.frame_id == mount.parent,
        expected=f"a transform from {mount.parent} to {mount.frame}",
        observed=f"the parent is {messages[-1].header.frame_id!r}" if messages else f"no transform to {mount.frame}",
        cause="header.frame_id is the parent, child_frame_id the sensor" if messages else missing,
        read=_READ,
    )
    correct = Transform(mount.translation, mount.quaternion)
    difference = difference_text(read_edge(messages[-1]), correct) if messages else "no transform"
    norm = _quaternion_norm(messages[-1]) if messages else 1.0
    is_unit = abs(norm - 1.0) <= TOLERANCE
    sheet.check(
        3,
        f"{mount.frame} is at the correct position",
        1.0 if not difference and is_unit else 2 / 3 if not difference else 0.0,
        expected=f"position {list(mount.translation)} m, rotation {_round_values(mount.quaternion)} (x, y, z, w)",
        observed=difference or f"the quaternion has the length {norm:.6f} instead of 1",
        cause=_pose_cause(messages, mount) if difference else _NOT_UNIT_CAUSE,
        read="handbook chapter 2, rotations and quaternions",
    )


def _round_values(values: tuple[float, ...]) -> list[float]:
    return [round(value, 7) for value in values]


def _quaternion_norm(message: Any) -> float:
    turned = message.transform.rotation
    return float(np.linalg.norm([turned.x, turned.y, turned.z, turned.w]))


def _pose_cause(messages: list[Any], mount: Mount) -> str:
    """Return the likely cause of a wrong pose."""
    if not messages:
        return "the transform is not sent"
    pose = read_edge(messages[-1])
    if not difference_text(pose, Transform(mount.translation)):
        return "the rotation is missing: the quaternion is the identity"
    x, y, z, w = pose.quaternion.tolist()
    for quaternion, cause in (
        ((y, z, w, x), "the quaternion is in the order w, x, y, z; ROS uses x, y, z, w"),
        ((-x, -y, -z, w), "the rotation is inverted"),
    ):
        if not difference_text(Transform(pose.translation, quaternion), Transform(mount.translation, mount.quaternion)):
            return cause
    inverse = Transform(mount.translation, mount.quaternion).inverse()
    if not difference_text(pose, inverse):
        return "the transform is inverted: it must be the pose of the sensor relative to its parent"
    return "values that differ from the assignment (lab.json, README.md)"


def _check_delivery(
    sheet: Sheet, task: Task, static: dict[str, list[Any]], dynamic: dict[str, list[Any]], late: dict[str, list[Any]]
) -> None:
    frames = [mount.frame for mount in task.assignment.mounts]
    on_static = [frame for frame in frames if frame in static and frame not in dynamic]
    sheet.check(
        2,
        "the transforms are on /tf_static",
        len(on_static) / len(frames),
        expected="all three on /tf_static, none on /tf",
        observed=f"{len(on_static)} of 3 on /tf_static, {len(set(frames) & dynamic.keys())} on /tf",
        cause=_WRONG_BROADCASTER_CAUSE,
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
        cause="your own publisher with default QoS: use StaticTransformBroadcaster",
        read=_READ,
    )
    reached = [frame for frame in frames if frame in late]
    sheet.check(
        3,
        "a listener that joins 5 s later receives the transforms",
        len(reached) / len(frames),
        expected="all three transforms",
        observed=f"{len(reached)} of 3: {', '.join(reached) or 'none'}",
        cause="one sendTransform call per transform: ROS 2 Humble delivers only the last call. Send one list",
        read=_READ,
    )
    most = max((len(static.get(frame, [])) for frame in frames), default=0)
    sheet.check(
        1,
        "the transforms are sent once",
        most == 1,
        expected="each transform is sent once",
        observed=f"sent {most} times in 5 s",
        cause="sendTransform in a timer: static transforms are stored by the middleware",
        read=_READ,
    )
