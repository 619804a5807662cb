# SPDX-License-Identifier: Apache-2.0
"""Types of unquoted words in parameters: the rules of rcl, which uses C's strtol and strtod."""

from __future__ import annotations

import math
import re
import sys
from typing import Final

_TRUE_WORDS: Final = {"y", "Y", "yes", "Yes", "YES", "true", "True", "TRUE", "on", "On", "ON"}
_FALSE_WORDS: Final = {"n", "N", "no", "No", "NO", "false", "False", "FALSE", "off", "Off", "OFF"}
_SPECIAL_FLOATS: Final = {
    **dict.fromkeys((".nan", ".NaN", ".NAN"), math.nan),
    **{f"{sign}{word}": float(f"{sign}inf") for sign in ("", "+", "-") for word in (".inf", ".Inf", ".INF")},
}
_SPACE: Final = r"[ \t\n\v\f\r]*"  # only block scalars can begin with it
_INTEGER: Final = re.compile(rf"{_SPACE}([-+]?)(0[xX][0-9a-fA-F]+|0[0-7]*|[1-9][0-9]*)")
_DECIMAL: Final = re.compile(rf"{_SPACE}[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?")
_HEXADECIMAL: Final = re.compile(
    rf"{_SPACE}[-+]?0[xX](?=\.?[0-9a-fA-F])([0-9a-fA-F]*)\.?([0-9a-fA-F]*)([pP][-+]?[0-9]+)?"
)
_NOT_FINITE: Final = re.compile(rf"{_SPACE}([-+]?)(inf|infinity|nan(?:\([0-9a-zA-Z_]*\))?)", re.IGNORECASE)
_MAX_DIGITS: Final = 30  # of an integer with 64 bits, in any form


def parse_scalar(text: str) -> bool | int | float | str:
    """Return the typed value of an unquoted word."""
    if text in _TRUE_WORDS or text in _FALSE_WORDS:
        return text in _TRUE_WORDS
    number: float | None = _integer(text)
    if number is None:
        number = _SPECIAL_FLOATS[text] if text in _SPECIAL_FLOATS else _double(text)
    return text if number is None else number


def _integer(text: str) -> int | None:
    """Return an integer as strtol reads it, in decimal, hexadecimal or octal form; None above 64 bits."""
    found = _INTEGER.fullmatch(text)
    if found is None:
        return None
    sign, digits = found.groups()
    significant = digits[2:] if digits[1:2] in {"x", "X"} else digits
    if len(significant.lstrip("0")) > _MAX_DIGITS:
        return None
    base = 16 if significant is not digits else 8 if digits.startswith("0") else 10
    number = int(sign + (significant.lstrip("0") or "0"), base)
    return number if -(2**63) <= number < 2**63 else None


def _double(text: str) -> float | None:
    """Parse a number like strtod. Return None if it is not a number or does not fit a double."""
    if found := _NOT_FINITE.fullmatch(text):
        return float(found[1] + found[2][:3])
    if _DECIMAL.fullmatch(text):
        value = float(text)
        return value if math.isfinite(value) and not (_is_tiny(value) and _underflows(text, value)) else None
    if found := _HEXADECIMAL.fullmatch(text):
        try:
            value = float.fromhex(text.strip())
        except OverflowError:
            return None
        return value if not _is_tiny(value) or not _hexadecimal_underflows(found, value) else None
    return None


def _is_tiny(value: float) -> bool:
    return abs(value) <= sys.float_info.min


def _underflows(text: str, value: float) -> bool:
    from rclpy import _underflow  # noqa: PLC0415 - tiny numbers are rare, and its imports take milliseconds

    return _underflow.of_decimal(text, value)


def _hexadecimal_underflows(found: re.Match[str], value: float) -> bool:
    from rclpy import _underflow  # noqa: PLC0415

    return _underflow.of_hexadecimal(found, value)
