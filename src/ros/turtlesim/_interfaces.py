# SPDX-License-Identifier: Apache-2.0
"""The interfaces of the turtle simulation, which are in the package turtlesim_msgs from Kilted on."""

from typing import TYPE_CHECKING

from coframe.distributions import removal

if TYPE_CHECKING or not removal("turtlesim/msg/Pose"):
    from turtlesim.action import RotateAbsolute
    from turtlesim.msg import Color, Pose
    from turtlesim.srv import Kill, SetPen, Spawn, TeleportAbsolute, TeleportRelative
else:
    from turtlesim_msgs.action import RotateAbsolute
    from turtlesim_msgs.msg import Color, Pose
    from turtlesim_msgs.srv import Kill, SetPen, Spawn, TeleportAbsolute, TeleportRelative

__all__ = [
    "Color",
    "Kill",
    "Pose",
    "RotateAbsolute",
    "SetPen",
    "Spawn",
    "TeleportAbsolute",
    "TeleportRelative",
]
