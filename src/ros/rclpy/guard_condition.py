# SPDX-License-Identifier: Apache-2.0
"""Guard conditions, which wake an executor from any thread."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from rclpy import _absent
from rclpy._absent import Handle
from rclpy._destroyable import Destroyable
from rclpy.utilities import get_default_context

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.callback_groups import CallbackGroup
    from rclpy.context import Context


class GuardCondition(Destroyable):
    """Condition whose callback runs once after a trigger. Create it with `Node.create_guard_condition`."""

    handle = Handle()

    def __init__(
        self,
        callback: Callable[[], Any] | None,
        callback_group: CallbackGroup | None,
        context: Context | None = None,
    ) -> None:
        self.callback = callback
        self.callback_group = callback_group
        self.__context = context or get_default_context()
        self.__is_triggered = False

    def trigger(self) -> None:
        """Schedule the callback. This may be called from any thread."""
        self.__is_triggered = True
        self.__context._Coframe__wakeup.set()

    def destroy(self) -> None:
        """Destroy the guard condition. Prefer `Node.destroy_guard_condition`."""
        self.__is_triggered = False

    def _Coframe__remaining_ns(self) -> int | None:
        return 0 if self.__is_triggered else None

    def _Coframe__take(self) -> Callable[[], Any] | None:
        if not self.__is_triggered:
            return None
        self.__is_triggered = False
        return self.callback


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
