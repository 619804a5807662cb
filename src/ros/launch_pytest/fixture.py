# SPDX-License-Identifier: Apache-2.0
"""The decorator of launch fixtures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["LaunchFixture", "fixture", "launch_fixture_of"]

_ATTRIBUTE = "_coframe_launch_fixture"


@dataclass(frozen=True, eq=False)
class LaunchFixture:
    """How a launch fixture was declared.

    Attributes:
        name: The name of the fixture.
        auto_shutdown: Whether the launch is shut down when the tests have run.
    """

    name: str
    auto_shutdown: bool


def fixture(decorated: Callable[..., Any] | None = None, *args: Any, **kwargs: Any) -> Any:
    """Declare a fixture that returns a launch description, whose processes run while tests use it.

    It has the arguments of ``pytest.fixture``. The value of the fixture may also be a tuple or list that begins with
    the launch description.

    Args:
        decorated: The function.
        args: Arguments of ``pytest.fixture``.
        kwargs: Keyword arguments of ``pytest.fixture``, and `auto_shutdown`: whether the launch is shut down when the
            tests have run, True by default; otherwise the tests after the shutdown wait for its end.
    """
    auto_shutdown = kwargs.pop("auto_shutdown", True)

    def decorate(function: Callable[..., Any]) -> Any:
        options = LaunchFixture(kwargs.get("name") or function.__name__, auto_shutdown)
        setattr(function, _ATTRIBUTE, options)
        declared = pytest.fixture(*args, **kwargs)(function)
        setattr(declared, _ATTRIBUTE, options)
        return declared

    return decorate if decorated is None else decorate(decorated)


def launch_fixture_of(function: object) -> LaunchFixture | None:
    """Return how a function or fixture was declared, or None if it is not a launch fixture."""
    found = getattr(function, _ATTRIBUTE, None)
    return found if isinstance(found, LaunchFixture) else None
