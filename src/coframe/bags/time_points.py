# SPDX-License-Identifier: Apache-2.0
"""Parse points in time as written by users (stamps, offsets and ISO 8601) to nanoseconds."""

from __future__ import annotations

import datetime
import re

from coframe import time

__all__ = ["parse_time_point"]

_NUMBER = re.compile(r"(\d+)(?:\.(\d*))?", re.ASCII)
_OFFSET = re.compile(r"([+-]?)\s*(\d.*[a-z])", re.ASCII)
_ISO = re.compile(r"(\d{4}-\d\d-\d\d[T ]\d\d:\d\d(?::\d\d)?)(?:\.(\d*))?\s*(Z|[+-]\d\d:?\d\d)?", re.ASCII)
_HINT = (
    'Write a stamp (1666859837.363141536), an offset from the start ("10s") or the end ("-2s"), '
    'or an ISO 8601 time ("2022-10-27T08:43:57Z")'
)


def parse_time_point(text: str, span: tuple[int, int]) -> int:
    """Parse a point in time.

    Args:
        text: One of: seconds with up to nine decimals, where integers too large for seconds are nanoseconds; an
            offset from the start such as ``10s`` or ``1.5min``, or from the end such as ``-2s``; ISO 8601 with a time
            zone; ``start`` or ``end``.
        span: Start and end of the recording in nanoseconds.

    Returns:
        Nanoseconds.

    Raises:
        ValueError: The text is none of these, has more than nine decimals, or does not fit into 64 bits.

    Example:
        >>> parse_time_point("1666859837.363141536", (0, 0))
        1666859837363141536
        >>> parse_time_point("10s", (5_000_000_000, 60_000_000_000))
        15000000000
    """
    text = text.strip()
    if text in {"start", "end"}:
        return span[0] if text == "start" else span[1]
    if match := _NUMBER.fullmatch(text):
        whole_seconds = int(match[1][:30])
        is_nanoseconds = match[2] is None and whole_seconds * time.SECOND >= 2**63
        return _check_range(
            text, whole_seconds if is_nanoseconds else whole_seconds * time.SECOND + _parse_fraction(text, match[2])
        )
    if match := _OFFSET.fullmatch(text):
        try:
            offset = time.duration_ns(match[2])
        except ValueError as error:
            raise ValueError(f"{error}; {_HINT}") from None
        return _check_range(text, span[1] - offset if match[1] == "-" else span[0] + offset)
    if match := _ISO.fullmatch(text):
        return _check_range(text, _parse_iso(text, match))
    raise ValueError(f"{text[:60]!r} is not a point in time. {_HINT}")


def _parse_fraction(text: str, digits: str | None) -> int:
    digits = (digits or "").rstrip("0")
    if len(digits) > 9:
        raise ValueError(f"{text!r} has more than nine decimals; the resolution is one nanosecond")
    return int(digits.ljust(9, "0"))


def _parse_iso(text: str, match: re.Match[str]) -> int:
    if match[3] is None:
        raise ValueError(f"{text!r} has no time zone: add Z for UTC, or an offset such as +02:00")
    zone = "+00:00" if match[3] == "Z" else match[3]
    zone = zone if ":" in zone else f"{zone[:3]}:{zone[3:]}"
    try:
        whole_seconds = datetime.datetime.fromisoformat(f"{match[1].replace(' ', 'T')}{zone}")
    except ValueError as error:
        raise ValueError(f"{text!r} is not a point in time: {error}") from None
    return time.stamp_ns(whole_seconds) + _parse_fraction(text, match[2])


def _check_range(text: str, nanoseconds: int) -> int:
    if not -(2**63) <= nanoseconds < 2**63:
        raise ValueError(f"{text[:60]!r} is after the year 2262, the last one that fits into 64-bit nanoseconds")
    return nanoseconds
