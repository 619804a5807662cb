# SPDX-License-Identifier: Apache-2.0
"""Robot models from URDF and xacro: links, joints and forward kinematics.

>>> import coframe.robots
>>> robot = coframe.robots.parse_urdf('<robot name="example"><link name="base"/></robot>')
>>> list(robot.frames())
['base']
"""

from coframe.errors import PackageError, RobotDescriptionError
from coframe.robots._packages import Packages
from coframe.robots._robot import Robot
from coframe.robots.files import expand_xacro, load
from coframe.robots.parts import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Inertial,
    Joint,
    JointLimits,
    Link,
    Material,
    Mesh,
    Mimic,
    Sphere,
    Visual,
)
from coframe.robots.urdf import parse_urdf

__all__ = [
    "Box",
    "Capsule",
    "Collision",
    "Cylinder",
    "Inertial",
    "Joint",
    "JointLimits",
    "Link",
    "Material",
    "Mesh",
    "Mimic",
    "PackageError",
    "Packages",
    "Robot",
    "RobotDescriptionError",
    "Sphere",
    "Visual",
    "expand_xacro",
    "load",
    "parse_urdf",
]


def __dir__() -> list[str]:
    return sorted(__all__)
