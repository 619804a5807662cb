# SPDX-License-Identifier: Apache-2.0
"""The decorator of test classes that run after the shutdown."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    import unittest
    from collections.abc import Callable

    _Case = TypeVar("_Case", bound=type[unittest.TestCase])

__all__ = ["post_shutdown_test"]


def post_shutdown_test() -> Callable[[_Case], _Case]:
    """Return a decorator for a test class that runs after all processes have ended."""

    def decorate(test_class: _Case) -> _Case:
        test_class.__post_shutdown_test__ = True  # type: ignore[attr-defined]
        return test_class

    return decorate
