# SPDX-License-Identifier: Apache-2.0
"""Parts of a lifecycle node that follow its state."""

from __future__ import annotations

from functools import partial, wraps
from typing import TYPE_CHECKING, Any

from rclpy import _absent
from rclpy.lifecycle.state_machine import TransitionCallbackReturn

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.lifecycle.node import LifecycleState


class ManagedEntity:
    """Part of a lifecycle node whose methods are called at the node's transitions."""

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Handle the transition to "inactive". `state` is the previous state."""
        del state
        return TransitionCallbackReturn.SUCCESS

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Handle the transition to "unconfigured". `state` is the previous state."""
        del state
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Handle the transition to "finalized". `state` is the previous state."""
        del state
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Handle the transition to "active". `state` is the previous state."""
        del state
        return TransitionCallbackReturn.SUCCESS

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Handle the transition from "active" to "inactive". `state` is the previous state."""
        del state
        return TransitionCallbackReturn.SUCCESS

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Handle an error of another callback. `state` is the state before the transition that failed."""
        del state
        return TransitionCallbackReturn.SUCCESS


class SimpleManagedEntity(ManagedEntity):
    """Managed entity that is enabled while the node is active."""

    def __init__(self) -> None:
        self.__enabled = False

    @property
    def is_activated(self) -> bool:
        """Whether the node is active."""
        return self.__enabled

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Enable the entity."""
        del state
        self.__enabled = True
        return TransitionCallbackReturn.SUCCESS

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Disable the entity."""
        del state
        self.__enabled = False
        return TransitionCallbackReturn.SUCCESS

    @staticmethod
    def when_enabled(
        wrapped: Callable[..., Any] | None = None, *, when_not_enabled: Callable[..., Any] | None = None
    ) -> Any:
        """Decorate a method so that it runs only while the entity is enabled.

        Args:
            wrapped: The method.
            when_not_enabled: Function that is called instead, with the same arguments. None ignores the call.
        """

        def decorate(method: Callable[..., Any]) -> Callable[..., Any]:
            @wraps(method)
            def run(self: SimpleManagedEntity, *args: Any, **kwargs: Any) -> Any:
                if self.is_activated:
                    return method(self, *args, **kwargs)
                return None if when_not_enabled is None else when_not_enabled(self, *args, **kwargs)

            return run

        return decorate if wrapped is None else decorate(wrapped)


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
