# SPDX-License-Identifier: Apache-2.0
"""Numbers that users pass: Python numbers, subclasses such as IntEnum, and NumPy numbers."""

from __future__ import annotations

from numbers import Number
from typing import Any

import coframe.lazy_numpy as np


def to_python(value: Any) -> Any:
    """Convert a number or boolean of NumPy to Python. Return other values unchanged.

    NumPy's integers must not be multiplied by 1e9, because the product does not fit into their types.
    """
    if not np.is_scalar(value):
        return value
    if isinstance(value, np.bool_):
        return bool(value)
    if isinstance(value, np.integer) and not isinstance(value, np.timedelta64):
        return int(value)
    return float(value) if isinstance(value, np.floating) else value


def require_number(value: Any) -> float:
    """Return a number of seconds or nanoseconds as a number of Python.

    Raises:
        TypeError: `value` is not a number. Multiplying a string or a list by 1e9 would repeat it a billion times.
    """
    if isinstance(value, int | float):
        return value
    number = to_python(value)
    if isinstance(number, Number) and not np.is_scalar(number):
        return number  # type: ignore[return-value] # Decimal and Fraction can be multiplied and truncated as well.
    if isinstance(value, str):
        raise TypeError(f"Expected a number, got the string {value!r}. Convert it with float(...) first.")
    if np.is_scalar(value) or not hasattr(value, "__float__"):
        raise TypeError(f"Expected a number, got {value!r} of type {type(value).__name__}.")
    return float(value)
