# SPDX-License-Identifier: Apache-2.0
"""The names of NumPy, which is imported when the first of them is used: its import takes as long as that of rclpy.

Modules that many programs import without using arrays write `import coframe.lazy_numpy as np`, and use `np` only inside
functions. They ask `is_array` whether a value is an array, which imports nothing.
"""

from __future__ import annotations

import importlib
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import builtins

    from numpy import *  # noqa: F403 - all names
    from typing_extensions import TypeIs


if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        # Programs that look at all modules, such as test frameworks, ask for __path__ or __warningregistry__.
        if name.startswith("__"):
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        value = getattr(importlib.import_module("numpy"), name)
        globals()[name] = value  # The next use does not come here.
        return value


def is_array(value: object) -> TypeIs[ndarray[Any, Any]]:  # noqa: F405
    """Return whether a value is a NumPy array. As long as NumPy is not imported, there is none."""
    return _is_instance(value, "ndarray")


def is_scalar(value: object) -> TypeIs[generic]:  # noqa: F405
    """Return whether a value is one of NumPy's numbers, booleans or times."""
    return _is_instance(value, "generic")


def _is_instance(value: object, name: str) -> builtins.bool:
    kind = getattr(sys.modules.get("numpy"), name, None)  # Another thread may be importing NumPy.
    return kind is not None and isinstance(value, kind)
