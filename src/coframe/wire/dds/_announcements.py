# SPDX-License-Identifier: Apache-2.0
"""Repeat the announcements of a new participant, because they are best-effort messages, which the network can lose.

Cyclone DDS announces a participant when it is created and 0.1 s later, then once per interval. A participant that
receives an announcement of an unknown one answers once per second, four times. A participant is announced again
immediately if its user data changes, so the user data contains a counter.
"""

from __future__ import annotations

import random
import time
from typing import TYPE_CHECKING, Final

from coframe.time import MILLISECOND, SECOND

if TYPE_CHECKING:
    from coframe import _core

_ENCLAVE: Final = "enclave=/;"  # user data of every ROS participant
_DELAYS: Final = (250 * MILLISECOND, 500 * MILLISECOND, 1000 * MILLISECOND)
_MAX_SHIFT: Final = 50 * MILLISECOND  # randomized for processes that start together


def participant_user_data(number: int = 0) -> str:
    """Return the user data of a participant after `number` repeated announcements."""
    return f"{_ENCLAVE}announcement={number};" if number else _ENCLAVE


class Announcements:
    """Announces a participant several more times after its start.

    Args:
        participant: The participant, just created.
        repeated: Whether to announce it again.
    """

    def __init__(self, participant: _core.DomainParticipant, *, repeated: bool) -> None:
        self._participant = participant
        self._number = 0
        start = time.monotonic_ns() + random.randrange(_MAX_SHIFT)  # noqa: S311 - not for cryptography
        self._due = [start + delay for delay in _DELAYS] if repeated else []

    def send_due(self) -> int:
        """Announce the participant if it is due. Return the time until the next call in nanoseconds."""
        now = time.monotonic_ns()
        if self._due and self._due[0] <= now:
            del self._due[0]
            self._number += 1
            self._participant.set_user_data(participant_user_data(self._number))
        return max(self._due[0] - now, 0) if self._due else SECOND
