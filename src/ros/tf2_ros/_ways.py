# SPDX-License-Identifier: Apache-2.0
"""The way in which a listener receives transforms: the first row of `WAYS` whose condition is true."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from tf2_ros._rclpy_side import IS_SOURCED, receiving_wire
from tf2_ros._sharing import is_shareable

if TYPE_CHECKING:
    from collections.abc import Callable

    from tf2_ros._subscriptions import Request, Subscriptions

__all__ = ["WAYS", "Way", "open_subscriptions"]


class Way(NamedTuple):
    """A way to receive transforms.

    Attributes:
        name: The name of the way.
        applies: Returns whether a listener uses it, unless an earlier row applies.
        opens: The module in tf2_ros and the class of the subscriptions. The modules of both sides are never imported in
            one process, because each needs its own rclpy.
    """

    name: str
    applies: Callable[[Request], bool]
    opens: str

    def open(self, request: Request) -> Subscriptions | None:
        """Open the subscriptions, or None if this way is not possible on this system."""
        module, _, name = self.opens.partition(".")
        kind: Any = getattr(import_module(f"tf2_ros.{module}"), name)
        subscriptions: Subscriptions | None = getattr(kind, "open", kind)(request)
        return subscriptions


def _uses_rclpy(request: Request) -> bool:
    return request.wire == "rclpy"


def _is_raw(request: Request) -> bool:
    # Only native subscriptions and the listener's own callbacks rename frames.
    return IS_SOURCED and _uses_rclpy(request) and request.renaming is None


def _is_shared_with_ros(request: Request) -> bool:
    return IS_SOURCED and is_shareable(request)


def _is_native_with_ros(request: Request) -> bool:
    del request
    return IS_SOURCED


def _always(request: Request) -> bool:
    del request
    return True


WAYS: Final = (
    Way("callback of an overridden method", lambda request: request.overridden, "_subscriptions.CallbackSubscriptions"),
    Way("raw messages of a sourced ROS", _is_raw, "_sourced_subscriptions.RawSubscriptions"),
    Way("callback", _uses_rclpy, "_subscriptions.CallbackSubscriptions"),
    Way("shared in a sourced ROS", _is_shared_with_ros, "_sourced_subscriptions.SourcedSharedSubscriptions"),
    Way("native in a sourced ROS", _is_native_with_ros, "_sourced_subscriptions.SourcedNativeSubscriptions"),
    Way("shared", is_shareable, "_shared_subscriptions.SharedSubscriptions"),
    Way("native", _always, "_native_subscriptions.NativeSubscriptions"),
)


def open_subscriptions(request: Request) -> Subscriptions:
    """Subscribe in the way of the first row that applies and is possible on this system.

    Raises:
        ValueError: COFRAME_ROS2_WIRE has an invalid value.
    """
    request = replace(request, wire=receiving_wire(request))
    opened = (way.open(request) for way in WAYS if way.applies(request))
    return next(subscriptions for subscriptions in opened if subscriptions is not None)
