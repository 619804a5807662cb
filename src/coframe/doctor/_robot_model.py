# SPDX-License-Identifier: Apache-2.0
"""The robot model of an observation."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from coframe.errors import RobotDescriptionError
from coframe.robots import Robot, parse_urdf

if TYPE_CHECKING:
    from coframe.doctor.observation import Observation

__all__ = ["model", "parse_robot"]


@lru_cache(maxsize=16)
def parse_robot(text: str) -> Robot:
    """Return the robot of a description.

    Raises:
        RobotDescriptionError: The description is empty or invalid.
    """
    return parse_urdf(text)


def model(observation: Observation) -> Robot | None:
    """Return the robot of the newest valid description, or None if there is none."""
    for text in reversed(observation.descriptions):
        try:
            return parse_robot(text)
        except RobotDescriptionError:
            continue
    return None
