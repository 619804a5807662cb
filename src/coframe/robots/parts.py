# SPDX-License-Identifier: Apache-2.0
"""The parts of a robot description: links, joints and shapes. Units are meters, radians and kilograms."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

if TYPE_CHECKING:
    from coframe.transform.transform import Transform

__all__ = [
    "Box",
    "Capsule",
    "Collision",
    "Cylinder",
    "Geometry",
    "Inertial",
    "Joint",
    "JointLimits",
    "JointType",
    "Link",
    "Material",
    "Mesh",
    "Mimic",
    "Sphere",
    "Visual",
]

Vector: TypeAlias = tuple[float, float, float]
JointType: TypeAlias = Literal["fixed", "revolute", "continuous", "prismatic", "floating", "planar"]


@dataclass(frozen=True)
class Box:
    """A box centered at its origin.

    Attributes:
        size: The lengths along x, y and z, in meters.
    """

    size: Vector


@dataclass(frozen=True)
class Cylinder:
    """A cylinder along z, centered at its origin. Units are meters."""

    radius: float
    length: float


@dataclass(frozen=True)
class Capsule:
    """A cylinder along z with a hemisphere at each end. `length` is the length of the cylinder. Units are meters."""

    radius: float
    length: float


@dataclass(frozen=True)
class Sphere:
    """A sphere centered at its origin, with the radius in meters."""

    radius: float


@dataclass(frozen=True)
class Mesh:
    """A shape from a mesh file.

    Attributes:
        filename: The file name in the description: ``package://...``, ``file://...`` or a path; see
            ``coframe.robots.Packages``.
        scale: The scale factors along x, y and z.
    """

    filename: str
    scale: Vector = (1.0, 1.0, 1.0)


Geometry: TypeAlias = "Box | Cylinder | Capsule | Sphere | Mesh"


@dataclass(frozen=True)
class Material:
    """The appearance of a surface.

    Attributes:
        name: The name, which can be empty.
        color: Red, green, blue and alpha from 0 to 1, or None if there is no color.
        texture: The file name in the description, or None if there is no texture.
    """

    name: str
    color: tuple[float, float, float, float] | None = None
    texture: str | None = None


@dataclass(frozen=True)
class Visual:
    """A visual shape of a link. `origin` is its pose relative to the link."""

    name: str
    origin: Transform
    geometry: Geometry
    material: Material | None


@dataclass(frozen=True)
class Collision:
    """A collision shape of a link. `origin` is its pose relative to the link."""

    name: str
    origin: Transform
    geometry: Geometry


@dataclass(frozen=True)
class Inertial:
    """The mass and inertia of a link.

    Attributes:
        origin: The pose of the inertial frame relative to the link: the center of mass and the axes of the inertia.
        mass: The mass in kilograms.
        inertia: ixx, ixy, ixz, iyy, iyz, izz about the center of mass, in kg m^2.
    """

    origin: Transform
    mass: float
    inertia: tuple[float, float, float, float, float, float]


@dataclass(frozen=True)
class Link:
    """A rigid body of a robot, with a frame of the same name."""

    name: str
    visuals: tuple[Visual, ...] = ()
    collisions: tuple[Collision, ...] = ()
    inertial: Inertial | None = None


@dataclass(frozen=True)
class JointLimits:
    """The limits of a joint, or None for limits that are not given.

    Positions are in rad or m, efforts in Nm or N, and times in seconds. The soft limits belong to a safety controller,
    which stops the joint before the hard limits. The acceleration, deceleration and jerk are limits of URDF 1.2.
    """

    lower: float | None = None
    upper: float | None = None
    effort: float | None = None
    velocity: float | None = None
    soft_lower: float | None = None
    soft_upper: float | None = None
    acceleration: float | None = None
    deceleration: float | None = None
    jerk: float | None = None


@dataclass(frozen=True)
class Mimic:
    """The rule by which a joint follows another joint: ``multiplier * position + offset``."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True)
class Joint:
    """A joint, which connects a child link to its parent link.

    Attributes:
        name: The unique name of the joint.
        type: One of `JointType`.
        parent: The parent link.
        child: The child link.
        origin: The pose of the child link relative to the parent link at position 0.
        axis: The unit vector of the rotation or translation axis, or the normal of a planar joint, expressed in the
            child link; zero if the joint cannot move.
        limits: The limits, which revolute and prismatic joints always have, or None if there are none.
        mimic: The rule by which it follows another joint, or None if it does not.
    """

    name: str
    type: JointType
    parent: str
    child: str
    origin: Transform
    axis: Vector
    limits: JointLimits | None = None
    mimic: Mimic | None = None

    @property
    def size(self) -> int:
        """The length of a position: 0 (fixed), 3 (planar: x, y, angle), 7 (floating: x, y, z, qx, qy, qz, qw) or 1."""
        return {"fixed": 0, "planar": 3, "floating": 7}.get(self.type, 1)
