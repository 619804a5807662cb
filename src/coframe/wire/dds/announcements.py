# SPDX-License-Identifier: Apache-2.0
"""Repeated announcements of a participant, because DDS announces it with best-effort messages.

Cyclone DDS announces a participant when it is created and then once per interval, and it answers the announcement of
an unknown participant once. If the network loses one of these, the two do not know each other until the next interval.
A participant is announced again at once if its user data changes, so they contain a number.
"""

from __future__ import annotations

import random
import time
from typing import TYPE_CHECKING, Final

from coframe import _core
from coframe.time import MILLISECOND, SECOND

if TYPE_CHECKING:
    from coframe.wire.dds.config import Repetition

_ENCLAVE: Final = "enclave=/;"  # the user data that every ROS participant has
_DELAYS: Final = (250 * MILLISECOND, 500 * MILLISECOND, 1000 * MILLISECOND)
_LARGEST_SHIFT: Final = 50 * MILLISECOND  # random, so that processes that start together do not send at the same time


def participant_user_data(number: int = 0) -> str:
    """Return the user data of a participant after `number` repeated announcements."""
    return f"{_ENCLAVE}announcement={number};" if number else _ENCLAVE


class Announcements:
    """Announces a participant again after its start and after it has found others.

    Args:
        participant: The participant.
        changed: Set whenever another participant appears.
        repetition: When to announce it again.
    """

    def __init__(self, participant: _core.DomainParticipant, changed: _core.Event, repetition: Repetition) -> None:
        self._participant = participant
        self._others = _core.ParticipantReader(participant.entity, changed) if repetition.when_others_appear else None
        self._number = 0
        self._due = self._planned() if repetition.at_start else []

    def send_due(self) -> int:
        """Announce the participant if it is time to. Return the time until the next call in nanoseconds."""
        if self._others is not None and self._others.take_new() and not self._due:
            self._due = self._planned()
        now = time.monotonic_ns()
        if self._due and self._due[0] <= now:
            del self._due[0]
            self._number += 1
            self._participant.set_user_data(participant_user_data(self._number))
        return max(self._due[0] - now, 0) if self._due else SECOND

    def close(self) -> None:
        """Stop looking for other participants."""
        if self._others is not None:
            self._others.close()

    @staticmethod
    def _planned() -> list[int]:
        start = time.monotonic_ns() + random.randrange(_LARGEST_SHIFT)  # noqa: S311 - not for cryptography
        return [start + delay for delay in _DELAYS]
