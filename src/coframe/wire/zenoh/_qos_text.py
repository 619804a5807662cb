# SPDX-License-Identifier: Apache-2.0
"""The quality of service in the liveliness tokens of rmw_zenoh_cpp, such as "2::,5:,:,:,,".

Reliability, durability, history and depth, deadline, lifespan, liveliness and lease. Default values are left empty.
"""

from __future__ import annotations

from typing import Final

from coframe.wire.qos import INFINITE, QoS

_RELIABLE, _BEST_EFFORT = 1, 2
_TRANSIENT_LOCAL, _VOLATILE = 1, 2
_KEEP_LAST, _KEEP_ALL = 1, 2
_AUTOMATIC, _MANUAL_BY_TOPIC = 1, 3
_DEFAULT_DEPTH: Final = 42
_INFINITE_SECONDS, _INFINITE_NANOSECONDS = divmod(INFINITE, 1_000_000_000)
_MAX_DEPTH: Final = 2**31 - 1


def encode_qos(qos: QoS) -> str:
    """Return a quality of service as a string."""
    reliability = _omit_default(_RELIABLE, _RELIABLE if qos.reliable else _BEST_EFFORT)
    durability = _omit_default(_VOLATILE, _TRANSIENT_LOCAL if qos.transient_local else _VOLATILE)
    history = _omit_default(_KEEP_LAST, _KEEP_ALL if qos.keep_all else _KEEP_LAST)
    liveliness = _omit_default(_AUTOMATIC, _MANUAL_BY_TOPIC if qos.manual_liveliness else _AUTOMATIC)
    depth = _omit_default(_DEFAULT_DEPTH, qos.depth)
    deadline, lifespan, lease = (_duration(value) for value in (qos.deadline, qos.lifespan, qos.lease))
    return f"{reliability}:{durability}:{history},{depth}:{deadline}:{lifespan}:{liveliness},{lease}"


def decode_qos(text: str) -> QoS | None:
    """Return the quality of service in a string, or None if it is not valid."""
    parts = [part.split(",") for part in text.split(":")]
    if [len(part) for part in parts] != [1, 1, 2, 2, 2, 3]:
        return None
    (reliability,), (durability,), (history, depth), deadline, lifespan, (liveliness, *lease) = parts
    try:
        return QoS(
            depth=min(max(_number(depth, _DEFAULT_DEPTH), 1), _MAX_DEPTH),
            reliable=_number(reliability, _RELIABLE) != _BEST_EFFORT,
            transient_local=_number(durability, _VOLATILE) == _TRANSIENT_LOCAL,
            keep_all=_number(history, _KEEP_LAST) == _KEEP_ALL,
            manual_liveliness=_number(liveliness, _AUTOMATIC) == _MANUAL_BY_TOPIC,
            deadline=_nanoseconds(deadline),
            lifespan=_nanoseconds(lifespan),
            lease=_nanoseconds(lease),
        )
    except ValueError:
        return None


def _omit_default(default: int, value: int) -> str:
    return "" if value == default else str(value)


def _duration(nanoseconds: int) -> str:
    seconds, rest = divmod(nanoseconds or INFINITE, 1_000_000_000)
    return f"{_omit_default(_INFINITE_SECONDS, seconds)},{_omit_default(_INFINITE_NANOSECONDS, rest)}"


def _nanoseconds(parts: list[str]) -> int:
    seconds, rest = _number(parts[0], _INFINITE_SECONDS), _number(parts[1], _INFINITE_NANOSECONDS)
    return min(seconds * 1_000_000_000 + rest, INFINITE) or INFINITE


def _number(text: str, default: int) -> int:
    if not text:
        return default
    if not text.isascii() or not text.isdigit() or len(text) > 20:
        raise ValueError(text)
    return int(text)
