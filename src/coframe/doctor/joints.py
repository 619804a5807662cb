# SPDX-License-Identifier: Apache-2.0
"""Joint states as arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.doctor.observation import JointStates

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

__all__ = ["joint_states"]


def joint_states(topic: str, stamps: Sequence[int], messages: Sequence[Any]) -> JointStates:
    """Return the positions in JointState messages; with fewer positions than names, those of the first joints."""
    positions: dict[str, NDArray[np.float64]] = {}
    for row, message in enumerate(messages):
        for name, position in zip(message.name, message.position, strict=False):
            if name not in positions:
                positions[name] = np.full(len(messages), np.nan)
            positions[name][row] = position
        for name in message.name[len(message.position) :]:
            positions.setdefault(name, np.full(len(messages), np.nan))
    return JointStates(topic, np.array(stamps, dtype=np.int64), positions)
