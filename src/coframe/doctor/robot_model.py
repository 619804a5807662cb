"""The robot that an observation describes."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from coframe.errors import RobotDescriptionError
from coframe.robots import Robot, parse_urdf

if TYPE_CHECKING:
    from coframe.doctor.observation import Observation

__all__ = ["model", "parsed"]


@lru_cache(maxsize=16)
def parsed(text: str) -> Robot:
    """A description's robot.

    Raises:
        RobotDescriptionError: It is empty or contradicts itself.
    """
    return parse_urdf(text)


def model(observation: Observation) -> Robot | None:
    """The newest description that can be read; None without one."""
    for text in reversed(observation.descriptions):
        try:
            return parsed(text)
        except RobotDescriptionError:
            continue
    return None
