# SPDX-License-Identifier: Apache-2.0
"""Joint states as arrays."""

from __future__ import annotations

from itertools import zip_longest
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.doctor.observation import ObservedJointStates

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

__all__ = ["joint_states"]

_MAX_POSITIONS = 10_000_000
"""For all joints and messages together, because one message can contain any number of joints."""


def joint_states(topic: str, stamps: Sequence[int], messages: Sequence[Any]) -> ObservedJointStates:
    """Return the positions in JointState messages; if there are fewer positions than names, for the first joints."""
    positions: dict[str, NDArray[np.float64]] = {}
    most = _MAX_POSITIONS // max(len(messages), 1)
    for row, message in enumerate(messages):
        for name, position in zip_longest(message.name, message.position[: len(message.name)]):
            if name not in positions:
                if len(positions) >= most:
                    continue
                positions[name] = np.full(len(messages), np.nan)
            if position is not None:
                positions[name][row] = position
    return ObservedJointStates(topic, np.array(stamps, dtype=np.int64), positions)
