"""What a robot is made of, as its description says: links, joints, shapes. Metres, radians, kilograms."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

if TYPE_CHECKING:
    from coframe.transform import Transform

__all__ = [
    "Box",
    "Capsule",
    "Collision",
    "Cylinder",
    "Geometry",
    "Inertial",
    "Joint",
    "JointType",
    "Limits",
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
    """A box around its origin.

    Attributes:
        size: Metres along x, y, z.
    """

    size: Vector


@dataclass(frozen=True)
class Cylinder:
    """A cylinder along z, around its origin."""

    radius: float
    length: float


@dataclass(frozen=True)
class Capsule:
    """A cylinder along z with half a sphere on both ends; ``length`` is the cylinder's."""

    radius: float
    length: float


@dataclass(frozen=True)
class Sphere:
    """A sphere around its origin."""

    radius: float


@dataclass(frozen=True)
class Mesh:
    """A shape in a file of its own.

    Attributes:
        filename: As written: ``package://...``, ``file://...`` or a path; see ``coframe.robots.Packages``.
        scale: Factors along x, y, z.
    """

    filename: str
    scale: Vector = (1.0, 1.0, 1.0)


Geometry: TypeAlias = "Box | Cylinder | Capsule | Sphere | Mesh"


@dataclass(frozen=True)
class Material:
    """How a surface looks.

    Attributes:
        name: May be empty.
        color: Red, green, blue, alpha from 0 to 1; None where it is not said.
        texture: A file, as written; None where there is none.
    """

    name: str
    color: tuple[float, float, float, float] | None = None
    texture: str | None = None


@dataclass(frozen=True)
class Visual:
    """What of a link is seen; ``origin`` is told in the link."""

    name: str
    origin: Transform
    geometry: Geometry
    material: Material | None


@dataclass(frozen=True)
class Collision:
    """What of a link is bumped into; ``origin`` is told in the link."""

    name: str
    origin: Transform
    geometry: Geometry


@dataclass(frozen=True)
class Inertial:
    """A link's mass in kilograms and its inertia in kg m^2.

    Attributes:
        origin: The centre of mass, and the axes that the inertia is told along, in the link.
        mass: Kilograms.
        inertia: ixx, ixy, ixz, iyy, iyz, izz about the centre of mass.
    """

    origin: Transform
    mass: float
    inertia: tuple[float, float, float, float, float, float]


@dataclass(frozen=True)
class Link:
    """A rigid part of a robot, and the frame that moves with it."""

    name: str
    visuals: tuple[Visual, ...] = ()
    collisions: tuple[Collision, ...] = ()
    inertial: Inertial | None = None


@dataclass(frozen=True)
class Limits:
    """How far and how hard a joint goes: rad, rad/s and Nm, or m, m/s and N; None where it is not said.

    The soft ones are a safety controller's, which keeps the joint from where it would be stopped hard.
    """

    lower: float | None = None
    upper: float | None = None
    effort: float | None = None
    velocity: float | None = None
    soft_lower: float | None = None
    soft_upper: float | None = None


@dataclass(frozen=True)
class Mimic:
    """A joint follows another one: ``multiplier * position + offset``."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True)
class Joint:
    """What ties a link to its parent.

    Attributes:
        name: The joint's name.
        type: One of ``JointType``.
        parent: The link it starts from.
        child: The link that it moves.
        origin: Where the child is at position 0, told in the parent.
        axis: Of unit length, in the child's frame: what it turns about or slides along; of a planar joint the normal
            of the plane.
        limits: None where none are given; revolute and prismatic joints have them.
        mimic: Whom it follows; None: nobody.
    """

    name: str
    type: JointType
    parent: str
    child: str
    origin: Transform
    axis: Vector
    limits: Limits | None = None
    mimic: Mimic | None = None

    @property
    def size(self) -> int:
        """How many numbers its position has: 0, 1, 3 (planar: x, y, angle) or 7 (floating: x, y, z, qx, qy, qz, qw)."""
        return {"fixed": 0, "planar": 3, "floating": 7}.get(self.type, 1)
