# SPDX-License-Identifier: Apache-2.0
"""Run a node of the lab with a fault. The arguments are the fault and the node."""

from __future__ import annotations

import importlib
import math
import sys
import time
from typing import TYPE_CHECKING, Any

import tf2_ros
from coframe._process.signal_handlers import SIGINT_EXIT_CODE

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["main"]

_DELAY = 20.0  # seconds
_OFFSET = 5  # seconds
_DROPOUT, _PERIOD = 1.0, 4.0  # seconds


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


_FAULTS: dict[str, Callable[[Any], None]] = {
    "late": _start_late,
    "offset": _offset_stamps,
    "dropout": _drop_transforms,
    "degrees": _use_degrees,
    "wrong parent": _change_parent,
    "dead": _stop_listener,
}


def _change_transforms(change: Callable[[list[Any]], list[Any]]) -> None:
    """Modify the transforms sent by a broadcaster."""
    send = tf2_ros.TransformBroadcaster.sendTransform

    def send_changed(self: Any, transform: Any) -> None:
        if changed := change(list(transform) if isinstance(transform, list) else [transform]):
            send(self, changed)

    tf2_ros.TransformBroadcaster.sendTransform = send_changed  # type: ignore[method-assign]


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
