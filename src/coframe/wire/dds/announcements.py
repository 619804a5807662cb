# SPDX-License-Identifier: Apache-2.0
"""Repeated announcements of a new participant, because the network can lose the best-effort messages that contain them.

Cyclone DDS announces a participant when it is created and 0.1 s later, then once per interval. A participant that
receives an announcement of an unknown one answers once per second, four times. A participant is announced again at
once if its user data changes, so they contain a number.
"""

from __future__ import annotations

import random
import time
from typing import TYPE_CHECKING, Final

from coframe.time import MILLISECOND, SECOND

if TYPE_CHECKING:
    from coframe import _core

_ENCLAVE: Final = "enclave=/;"  # the user data that every ROS participant has
_DELAYS: Final = (250 * MILLISECOND, 500 * MILLISECOND, 1000 * MILLISECOND)
_LARGEST_SHIFT: Final = 50 * MILLISECOND  # random, so that processes that start together do not send at the same time


def participant_user_data(number: int = 0) -> str:
    """Return the user data of a participant after `number` repeated announcements."""
    return f"{_ENCLAVE}announcement={number};" if number else _ENCLAVE


class Announcements:
    """Announces a participant again several times after its start.

    Args:
        participant: The participant, which has just been created.
        repeated: Whether to announce it again.
    """

    def __init__(self, participant: _core.DomainParticipant, *, repeated: bool) -> None:
        self._participant = participant
        self._number = 0
        start = time.monotonic_ns() + random.randrange(_LARGEST_SHIFT)  # noqa: S311 - not for cryptography
        self._due = [start + delay for delay in _DELAYS] if repeated else []

    def send_due(self) -> int:
        """Announce the participant if it is time to. Return the time until the next call in nanoseconds."""
        now = time.monotonic_ns()
        if self._due and self._due[0] <= now:
            del self._due[0]
            self._number += 1
            self._participant.set_user_data(participant_user_data(self._number))
        return max(self._due[0] - now, 0) if self._due else SECOND
