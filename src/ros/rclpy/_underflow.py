# SPDX-License-Identifier: Apache-2.0
"""Numbers below the normal ones, which rcl's parser of parameters does not accept if they are not exact."""

from __future__ import annotations

import re
import sys
from decimal import Context, Decimal
from fractions import Fraction
from typing import Final

# Smaller numbers are below the normal ones, even after rounding to 53 bits.
_NORMAL: Final = Fraction(sys.float_info.min) - Fraction(1, 2**1076)
_DECIMAL_NORMAL: Final = Context(prec=1200).divide(Decimal(_NORMAL.numerator), Decimal(_NORMAL.denominator))


def of_decimal(text: str, value: float) -> bool:
    """Return whether a decimal number below the normal ones is not exact, which strtod reports as an error."""
    if not value:
        return any(digit in re.split("[eE]", text)[0] for digit in "123456789")
    number = Decimal(text.strip()).copy_abs()
    return number != Decimal(value).copy_abs() and number < _DECIMAL_NORMAL


def of_hexadecimal(match: re.Match[str], value: float) -> bool:
    """Return the same for a hexadecimal number.

    Args:
        match: Its groups are the digits before and after the point, and the exponent.
        value: The number as a float.
    """
    whole, fraction, exponent = match.groups()
    mantissa = (whole + fraction).strip("0")
    if not value:
        return bool(mantissa)
    number = Fraction(int(whole + fraction, 16)) * Fraction(2) ** (int((exponent or "p0")[1:]) - 4 * len(fraction))
    return number != abs(Fraction(value)) and number < _NORMAL
