# SPDX-License-Identifier: Apache-2.0
"""Adds the plugins of launch_testing and launch_pytest to the session of pytest that imports them.

They are not entry points of the installed package: for these, pytest would load a plugin in each session and rewrite
all modules of coframe for its assertions, which takes a second, although no test may use launch fixtures.
"""

from __future__ import annotations

import importlib
import importlib.util
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

__all__ = ["add_plugin", "require_pytest"]


def require_pytest(purpose: str) -> None:
    """Check that pytest is installed.

    Args:
        purpose: The feature that needs it; the subject of the message.

    Raises:
        ModuleNotFoundError: It is not installed.
    """
    if importlib.util.find_spec("pytest") is None:
        raise ModuleNotFoundError(f"{purpose} needs pytest, which is not installed: pip install pytest", name="pytest")


def add_plugin(module: str) -> None:
    """Add a plugin to the session of pytest that is importing this; do nothing without one.

    Args:
        module: Name of the module of the plugin, which is also the name of the plugin.
    """
    pytest: Any = sys.modules.get("pytest")
    if pytest is None or not hasattr(pytest, "Config"):
        return
    # pytest has no function that returns its session, but files of tests and conftest.py are imported within it.
    config = next((value for value in _values_of_callers() if isinstance(value, pytest.Config)), None)
    if config is not None and not config.pluginmanager.has_plugin(module):
        config.pluginmanager.register(importlib.import_module(module), module)


def _values_of_callers() -> Iterator[object]:
    """Yield the local variables of the running functions, the innermost function first."""
    frame: FrameType | None = sys._getframe(1)  # noqa: SLF001 - the standard library has no public name
    while frame is not None:
        yield from list(frame.f_locals.values())
        frame = frame.f_back
