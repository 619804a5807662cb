# SPDX-License-Identifier: Apache-2.0
"""What publishers, subscriptions, timers and other entities of a node have in common: how they are destroyed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.exceptions import InvalidHandle, _with_hint

if TYPE_CHECKING:
    from types import TracebackType

    from typing_extensions import Self

__all__ = ["Destroyable", "LoggingEntity", "destroyed_error"]


class Destroyable:
    """Base class of entities. At the end of a `with` block, the entity is destroyed."""

    def destroy(self) -> None:
        """Destroy the entity."""
        raise NotImplementedError(f"{type(self).__name__} does not implement destroy()")

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_value: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.destroy()


class LoggingEntity(Destroyable):
    """Base class of publishers, subscriptions, clients and services, which log with the logger of their node."""

    _Coframe__logger_name = ""

    @property
    def logger_name(self) -> str:
        """The name of the node's logger."""
        return self._Coframe__logger_name


def destroyed_error(what: str) -> InvalidHandle:
    """Return the error for a destroyed entity, with rclpy's message and a hint that names the entity.

    Args:
        what: Description of the entity, with which a sentence starts.
    """
    return _with_hint(
        InvalidHandle("cannot use Destroyable because destruction was requested"), f"{what} was destroyed before."
    )
