# SPDX-License-Identifier: Apache-2.0
"""The protocol of objects that can be destroyed, for annotations."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Protocol

from rclpy import _absent

if TYPE_CHECKING:
    from types import TracebackType

__all__ = ["DestroyableType"]


class DestroyableType(Protocol):
    """An object that is a context manager and can be destroyed."""

    def __enter__(self) -> None: ...

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None: ...

    def destroy_when_not_in_use(self) -> None:
        """Destroy the object as soon as no context manager uses it."""


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
