# SPDX-License-Identifier: Apache-2.0
"""The interfaces of the turtle simulation, which are in the package turtlesim_msgs from Kilted on."""

from typing import TYPE_CHECKING

from coframe.distributions import removal

if TYPE_CHECKING or not removal("turtlesim/msg/Pose"):
    from turtlesim.msg import Pose
    from turtlesim.srv import Spawn
else:
    from turtlesim_msgs.msg import Pose
    from turtlesim_msgs.srv import Spawn

__all__ = ["Pose", "Spawn"]
