# SPDX-License-Identifier: Apache-2.0
"""Signed durations, as users write offsets of times."""

from __future__ import annotations

import re

from coframe.bags._message_fields import MAX_STAMP
from coframe.errors import EditError
from coframe.time import SECOND, duration_ns

__all__ = ["parse_offset"]

_OFFSET = re.compile(r"([+-]?)\s*(\d.*)", re.ASCII | re.DOTALL)
_BARE_NUMBER = re.compile(r"\d+(\.\d+)?", re.ASCII)


def parse_offset(text: str) -> int:
    """Return a signed duration such as ``+35ms`` or ``-1h`` in nanoseconds; a bare number is in seconds.

    Raises:
        EditError: The text is not a duration.

    Example:
        >>> parse_offset("+35ms"), parse_offset("-1h"), parse_offset("0.5")
        (35000000, -3600000000000, 500000000)
    """
    match = _OFFSET.fullmatch(text.strip())
    amount = match[2].strip() if match else ""
    try:
        size = duration_ns(f"{amount}s" if _BARE_NUMBER.fullmatch(amount) else amount)
    except (ValueError, TypeError):
        raise EditError(f"{text[:60]!r} is not a duration such as +35ms, -1h or 0.5s") from None
    if not match or size >= MAX_STAMP:
        raise EditError(
            f"{text[:60]!r} is not a duration such as +35ms, -1h or 0.5s of less than {MAX_STAMP // SECOND} s"
        )
    return -size if match[1] == "-" else size
