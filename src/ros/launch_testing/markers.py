# SPDX-License-Identifier: Apache-2.0
"""Marks of test descriptions and of tests."""

from __future__ import annotations

import functools
import time
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable

    _Function = TypeVar("_Function", bound=Callable[..., Any])

__all__ = ["keep_alive", "retry_on_failure"]


def keep_alive(test_description: _Function) -> _Function:
    """Mark a function ``generate_test_description``: the launch continues when all its processes have ended."""
    marks = getattr(test_description, "__markers__", {})
    test_description.__markers__ = {**marks, "keep_alive": True}  # type: ignore[attr-defined]
    return test_description


def retry_on_failure(*, times: int, delay: float | None = None) -> Callable[[_Function], _Function]:
    """Return a decorator for a test method that is repeated if an assertion fails.

    Args:
        times: How often it is run at most, at least 1.
        delay: Seconds between two runs.
    """
    if times < 1:
        raise ValueError(f"times must be at least 1, got {times}.")

    def decorate(test: _Function) -> _Function:
        @functools.wraps(test)
        def run(*args: Any, **kwargs: Any) -> Any:
            for _ in range(times - 1):
                try:
                    return test(*args, **kwargs)
                except AssertionError:
                    time.sleep(delay or 0.0)
            return test(*args, **kwargs)

        return run  # type: ignore[return-value]

    return decorate
