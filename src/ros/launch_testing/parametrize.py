# SPDX-License-Identifier: Apache-2.0
"""The decorator that runs the tests of a file with several values."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

__all__ = ["parametrize"]


def parametrize(
    argnames: str | Sequence[str], argvalues: Iterable[Any]
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return a decorator for ``generate_test_description``: the tests run once for each value.

    Args:
        argnames: Names of its arguments, as a sequence or separated by commas.
        argvalues: The values; with several names, each is a sequence of the same length.

    Raises:
        ValueError: The number of values differs from the number of names.
    """
    names = [name.strip() for name in argnames.split(",") if name.strip()] if isinstance(argnames, str) else argnames
    rows = [(value,) if len(names) == 1 else tuple(value) for value in argvalues]
    for row in rows:
        if len(row) != len(names):
            raise ValueError(f"{row} has {len(row)} values for the {len(names)} arguments {', '.join(names)}.")

    def decorate(function: Callable[..., Any]) -> Callable[..., Any]:
        inner = getattr(function, "__parametrized__", None)

        def bound() -> Iterator[tuple[Callable[..., Any], dict[str, Any]]]:
            for row in rows:
                values = dict(zip(names, row, strict=True))
                for call, others in inner() if inner is not None else [(function, {})]:
                    yield functools.partial(call, **values), {**others, **values}

        @functools.wraps(function)
        def wrapper(*args: Any, **kwargs: Any) -> Any:
            return function(*args, **kwargs)

        wrapper.__parametrized__ = bound  # type: ignore[attr-defined]
        return wrapper

    return decorate
