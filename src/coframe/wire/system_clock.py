# SPDX-License-Identifier: Apache-2.0
"""Check that the time of the system clock can be represented in messages.

The clock of a board without a battery has an arbitrary time until it is set, and any clock can be set by mistake.
"""

from __future__ import annotations

import time
from datetime import datetime, timedelta
from typing import Final

from coframe.errors import WireError

MAX_SECONDS: Final = 2**32 - 2  # in DDS; 2106-02-07
MAX_STAMP_SECONDS: Final = 2**31 - 1  # in builtin_interfaces/Time; 2038-01-19

_HINT: Final = (
    "Set the clock, for example with: sudo date --set '2027-01-31 12:00', or let a time server do it: sudo timedatectl "
    "set-ntp true"
)


def clock_fault() -> WireError | None:
    """Return an error if no messages can be sent at the time of the system clock, else None."""
    if 0 <= time.time() <= MAX_SECONDS:
        return None
    return _error("messages can only have times from 1970-01-01 to 2106-02-07.")


def stamp_fault() -> WireError | None:
    """Return an error if the time of the system clock cannot be the stamp of a ROS 2 message, else None."""
    if time.time() <= MAX_STAMP_SECONDS:
        return clock_fault()
    return _error("the stamps of ROS 2 messages end at 2038-01-19.")


def _error(limit: str) -> WireError:
    # Some systems cannot convert negative times.
    now = datetime(1970, 1, 1) + timedelta(seconds=int(time.time()))  # noqa: DTZ001
    return WireError(f"The system clock says {now} UTC, but {limit}", hint=_HINT)
