"""Waking an executor by hand."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.callback_groups import CallbackGroup
from rclpy.context import Context
from rclpy.utilities import get_default_context


class GuardCondition:
    """Its callback runs once after it was triggered; made by `Node.create_guard_condition`."""

    def __init__(
        self,
        callback: Callable[[], Any] | None,
        callback_group: CallbackGroup,
        context: Context | None = None,
    ) -> None:
        self.callback = callback
        self.callback_group = callback_group
        self._context = context or get_default_context()
        self._is_triggered = False

    def trigger(self) -> None:
        """Makes the callback due; from any thread."""
        self._is_triggered = True
        self._context._wakeup.set()

    def destroy(self) -> None:
        """Ends it; better use `Node.destroy_guard_condition`."""
        self._is_triggered = False

    def _remaining_ns(self) -> int | None:
        return 0 if self._is_triggered else None

    def _take(self) -> Callable[[], Any] | None:
        if not self._is_triggered:
            return None
        self._is_triggered = False
        return self.callback
