# SPDX-License-Identifier: Apache-2.0
"""Run a node of the lab with a fault. The arguments are the fault and the node."""

from __future__ import annotations

import copy
import importlib
import itertools
import math
import sys
import time
from typing import TYPE_CHECKING, Any

import tf2_ros
from coframe._process.signal_handlers import SIGINT_EXIT_CODE

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["main"]

_DELAY = 60.0  # seconds
_OFFSET = 5  # seconds
_DROPOUT, _PERIOD = 1.0, 4.0  # seconds
_JUMP, _JUMP_PERIOD = 0.5, 40  # meters and messages


def _start_late(_module: Any) -> None:
    time.sleep(_DELAY)


def _offset_stamps(_module: Any) -> None:
    def shift(transforms: list[Any]) -> list[Any]:
        stamps = {id(each.header.stamp): each.header.stamp for each in transforms}  # transforms may share one
        for stamp in stamps.values():
            stamp.sec -= _OFFSET
        return transforms

    _change_transforms(shift)


def _drop_transforms(_module: Any) -> None:
    _change_transforms(lambda transforms: [] if time.monotonic() % _PERIOD < _DROPOUT else transforms)


def _use_degrees(module: Any) -> None:
    broadcast = module.DynamicFramePublisher.broadcast_arm_transforms
    module.DynamicFramePublisher.broadcast_arm_transforms = lambda self, q1, q2, stamp: broadcast(
        self, math.degrees(q1), math.degrees(q2), stamp
    )


def _change_parent(_module: Any) -> None:
    def move(transforms: list[Any]) -> list[Any]:
        for each in transforms:
            if each.child_frame_id == "link2":
                each.header.frame_id = "base_link"
        return transforms

    _change_transforms(move)


def _stop_listener(module: Any) -> None:
    module.TransformListenerNode.query_transforms = lambda self: self.timer.cancel()


def _zero_quaternion(transform: Any) -> None:
    rotated = transform.transform.rotation
    rotated.x = rotated.y = rotated.z = rotated.w = 0.0


def _round_quaternion(transform: Any) -> None:
    rotated = transform.transform.rotation
    rotated.y = rotated.w = 0.707


def _add_slash(transform: Any) -> None:
    transform.header.frame_id = f"/{transform.header.frame_id}"
    transform.child_frame_id = f"/{transform.child_frame_id}"


def _use_millimeters(transform: Any) -> None:
    translation = transform.transform.translation
    translation.x, translation.y, translation.z = 1000.0 * translation.x, 1000.0 * translation.y, 1000.0 * translation.z


def _exchange_frames(transform: Any) -> None:
    transform.header.frame_id, transform.child_frame_id = transform.child_frame_id, transform.header.frame_id


def _change_camera(change: Callable[[Any], None]) -> Callable[[Any], None]:
    """Return a fault of the mount of the camera."""

    def apply(_module: Any) -> None:
        def changed(transforms: list[Any]) -> list[Any]:
            for each in transforms:
                if each.child_frame_id == "camera_link":
                    change(each)
            return transforms

        _change_transforms(changed, tf2_ros.StaticTransformBroadcaster)

    return apply


def _send_static_on_tf(module: Any) -> None:
    module.StaticTransformBroadcaster = tf2_ros.TransformBroadcaster


def _send_dynamic_on_tf_static(module: Any) -> None:
    module.TransformBroadcaster = tf2_ros.StaticTransformBroadcaster


def _stamp_ahead(_module: Any) -> None:
    def shift(transforms: list[Any]) -> list[Any]:
        for stamp in {id(each.header.stamp): each.header.stamp for each in transforms}.values():
            stamp.sec += _OFFSET
        return transforms

    _change_transforms(shift)


def _freeze_stamps(_module: Any) -> None:
    first: list[Any] = []

    def freeze(transforms: list[Any]) -> list[Any]:
        first.extend(() if first else [copy.deepcopy(transforms[0].header.stamp)])
        for each in transforms:
            each.header.stamp = first[0]
        return transforms

    _change_transforms(freeze)


def _clear_stamps(_module: Any) -> None:
    def clear(transforms: list[Any]) -> list[Any]:
        for each in transforms:
            each.header.stamp = type(each.header.stamp)()
        return transforms

    _change_transforms(clear)


def _change_angles(change: Callable[[float, float], tuple[float, float]]) -> Callable[[Any], None]:
    """Return a fault of the joint angles."""

    def apply(module: Any) -> None:
        broadcast = module.DynamicFramePublisher.broadcast_arm_transforms
        module.DynamicFramePublisher.broadcast_arm_transforms = lambda self, q1, q2, stamp: broadcast(
            self, *change(q1, q2), stamp
        )

    return apply


def _hang_arm_on_itself(_module: Any) -> None:
    def close(transforms: list[Any]) -> list[Any]:
        for each in transforms:
            if each.child_frame_id == "link1":
                each.header.frame_id = "end_effector"
        return transforms

    _change_transforms(close)


def _turn_in_degrees(transform: Any) -> None:
    half = 90.0 / 2.0
    rotated = transform.transform.rotation
    rotated.y, rotated.w = math.sin(half), math.cos(half)


def _jump(_module: Any) -> None:
    messages = itertools.count(1)

    def jump(transforms: list[Any]) -> list[Any]:
        if next(messages) % _JUMP_PERIOD == 0:
            for each in transforms:
                if each.child_frame_id == "link1":
                    each.transform.translation.y += _JUMP
        return transforms

    _change_transforms(jump)


def _stop_lidar(module: Any) -> None:
    module.SimulatedLidar.publish_scan = lambda _self: None


_FAULTS: dict[str, Callable[[Any], None]] = {
    "late": _start_late,
    "offset": _offset_stamps,
    "dropout": _drop_transforms,
    "degrees": _use_degrees,
    "wrong parent": _change_parent,
    "dead": _stop_listener,
    "zero quaternion": _change_camera(_zero_quaternion),
    "rounded quaternion": _change_camera(_round_quaternion),
    "slash": _change_camera(_add_slash),
    "millimeters": _change_camera(_use_millimeters),
    "exchanged frames": _change_camera(_exchange_frames),
    "static on tf": _send_static_on_tf,
    "dynamic on tf_static": _send_dynamic_on_tf_static,
    "ahead": _stamp_ahead,
    "frozen": _freeze_stamps,
    "no stamp": _clear_stamps,
    "whole angle": _change_angles(lambda q1, q2: (2.0 * q1, 2.0 * q2)),
    "sign": _change_angles(lambda q1, q2: (-q1, -q2)),
    "exchanged joints": _change_angles(lambda q1, q2: (q2, q1)),
    "loop": _hang_arm_on_itself,
    "mount in degrees": _change_camera(_turn_in_degrees),
    "jumps": _jump,
    "silent lidar": _stop_lidar,
}


def _change_transforms(change: Callable[[list[Any]], list[Any]], broadcaster: Any = None) -> None:
    """Modify the transforms sent by a broadcaster, by default by TransformBroadcaster."""
    chosen: Any = broadcaster or tf2_ros.TransformBroadcaster
    send = chosen.sendTransform

    def send_changed(self: Any, transform: Any) -> None:
        if changed := change(list(transform) if isinstance(transform, list) else [transform]):
            send(self, changed)

    chosen.sendTransform = send_changed


def main() -> None:
    """Run the node in the second argument with the fault in the first one."""
    fault, name = sys.argv[1:3]
    del sys.argv[1:3]
    try:
        module = importlib.import_module(f"coframe.lab.{name}")
        _FAULTS[fault](module)
        module.main()
    except KeyboardInterrupt:  # Ctrl-C before the node handles it
        sys.exit(SIGINT_EXIT_CODE)


if __name__ == "__main__":
    main()
