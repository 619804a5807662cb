# SPDX-License-Identifier: Apache-2.0
"""The package `eclipse-zenoh`, which provides the module `zenoh`."""

from __future__ import annotations

import importlib.util
from typing import TYPE_CHECKING, Final

from coframe._process.optional_imports import import_optional
from coframe.errors import WireError

if TYPE_CHECKING:
    from types import ModuleType

_MODULES: Final = ("zenoh", "xxhash")


def is_installed() -> bool:
    """Return whether the packages that Zenoh needs are installed, without importing them."""
    try:
        return all(importlib.util.find_spec(name) is not None for name in _MODULES)
    except (ImportError, ValueError):  # blocked, for example by tests
        return False


def check() -> None:
    """Check that the packages that Zenoh needs are installed, without importing them.

    Raises:
        WireError: One of them is not installed.
    """
    if not is_installed():
        load()


def load() -> ModuleType:
    """Return the module `zenoh`.

    Raises:
        WireError: A package that Zenoh needs is not installed.
    """
    try:
        loaded = [import_optional(name, "Communication over Zenoh", "zenoh") for name in _MODULES]
    except ModuleNotFoundError as error:
        raise WireError(str(error), hint="COFRAME_WIRE=dds selects DDS instead.") from error
    import_optional("zenoh.ext", "Communication over Zenoh", "zenoh")
    return loaded[0]  # type: ignore[no-any-return]
