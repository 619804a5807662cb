# SPDX-License-Identifier: Apache-2.0
"""A check of the type of an argument."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

__all__ = ["ensure_argument_type"]


def ensure_argument_type(
    argument: object, types: type[Any] | Iterable[type[Any]], argument_name: str, caller: str | None = None
) -> None:
    """Check the type of an argument.

    Raises:
        TypeError: The argument is not an instance of any of the types.
    """
    allowed = tuple(types) if isinstance(types, Iterable) else (types,)
    if not isinstance(argument, allowed):
        names = "', '".join(str(each) for each in allowed)
        where = f" to {caller}" if caller else ""
        raise TypeError(f"'{argument_name}' argument{where} has type '{type(argument)}', expected one of: '{names}'.")
