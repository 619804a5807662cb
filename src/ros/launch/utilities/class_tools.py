# SPDX-License-Identifier: Apache-2.0
"""Functions about classes."""

from __future__ import annotations

import inspect
from typing import Any, TypeGuard, TypeVar

__all__ = ["is_a", "is_a_subclass", "isclassinstance"]

T = TypeVar("T")


def isclassinstance(obj: object) -> bool:
    """Return whether an object is an instance of a class, and neither a class nor a module nor a function."""
    return not (inspect.isclass(obj) or inspect.ismodule(obj) or inspect.isroutine(obj))


def is_a(obj: object, entity_type: type[T]) -> TypeGuard[T]:
    """Return whether an object is an instance of a class."""
    return isinstance(obj, entity_type)


def is_a_subclass(obj: Any, entity_type: type[Any]) -> bool:
    """Return whether an object is a class derived from another one, or an instance of such a class."""
    return issubclass(obj if inspect.isclass(obj) else type(obj), entity_type)
