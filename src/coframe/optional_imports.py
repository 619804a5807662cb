# SPDX-License-Identifier: Apache-2.0
"""Imports of packages that only some features need."""

from __future__ import annotations

import importlib
import logging
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator


def import_optional(module: str, purpose: str, install: str) -> Any:
    """Return a module that coframe does not require.

    Args:
        module: Name of the module.
        purpose: What needs the module: the subject of the error's sentence.
        install: What `pip install` gets to install it.

    Raises:
        ModuleNotFoundError: The module is not installed. The text says how to install it.
    """
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name != module.partition(".")[0]:
            raise  # The module is there, but something that it needs is not.
        raise ModuleNotFoundError(
            f"{purpose} needs the module {module}, which is not installed: pip install '{install}'", name=error.name
        ) from None


@contextmanager
def importing_matplotlib() -> Iterator[None]:
    """Return a context manager that imports matplotlib without its warnings.

    With a read-only home folder, matplotlib caches its fonts in a temporary folder by itself, but prints two warnings.
    """
    log = logging.getLogger("matplotlib")
    level = log.level
    log.setLevel(logging.ERROR)
    try:
        yield
    finally:
        log.setLevel(level)
