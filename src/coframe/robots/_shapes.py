# SPDX-License-Identifier: Apache-2.0
"""Parse URDF links: visuals, collisions, materials and inertia."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.robots.parts import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Geometry,
    Inertial,
    Link,
    Material,
    Mesh,
    Sphere,
    Visual,
)
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from coframe.robots._document import Element

__all__ = ["Materials", "origin", "parse_link"]

_MAX_ANGLE = 6.3  # radians; of one turn, rounded up
_ZEROS = (0.0, 0.0, 0.0)
_INERTIA = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


class Materials:
    """The materials that a description defines, at the top level or in links. Undefined ones cause warnings."""

    def __init__(self, root: Element) -> None:
        self.defined: dict[str, Material] = {}
        for element in root.all("material"):
            material = _material(element)
            if not material.name:
                element.warn("a <material> has no name, so it is ignored")
            elif self.defined.setdefault(material.name, material) != material:
                element.warn(
                    f"material {material.name!r} is defined twice with different values; the first one is used"
                )
        for link in root.all("link"):
            for visual in link.all("visual"):
                for element in filter(_defines_material, visual.all("material")):
                    material = _material(element)
                    self.defined.setdefault(material.name, material)

    def material_of_visual(self, visual: Element) -> Material | None:
        """Return the material of a visual, or None if it has none."""
        element = visual.one("material")
        if element is None:
            return None
        if _defines_material(element):
            return _material(element)
        name = element.attributes.get("name", "").strip()
        if name and name not in self.defined:
            element.warn(f"material {name!r} is not defined")
        return self.defined.get(name)


def _defines_material(element: Element) -> bool:
    return bool(element.children)


def _material(element: Element) -> Material:
    color, texture = element.one("color"), element.one("texture")
    rgba = None if color is None else color.parse_or_warn(_rgba, "the color")
    filename = None if texture is None else texture.attributes.get("filename", "").strip() or None
    return Material(element.attributes.get("name", "").strip(), rgba, filename)


def _rgba(color: Element) -> tuple[float, float, float, float]:
    r, g, b, a = color.numbers("rgba", 4)
    return r, g, b, a


def parse_link(name: str, element: Element, materials: Materials) -> Link:
    """Return the link that a <link> element describes. Invalid parts are ignored, with a warning."""

    def visual(part: Element) -> Visual:
        pose, geometry = origin(part, name), _geometry(part)
        return Visual(part.attributes.get("name", ""), pose, geometry, materials.material_of_visual(part))

    def collision(part: Element) -> Collision:
        return Collision(part.attributes.get("name", ""), origin(part, name), _geometry(part))

    def inertial(part: Element) -> Inertial:
        return _inertial(part, name)

    mass = element.one("inertial")
    return Link(
        name,
        tuple(filter(None, (part.parse_or_warn(visual, "the <visual>") for part in element.all("visual")))),
        tuple(filter(None, (part.parse_or_warn(collision, "the <collision>") for part in element.all("collision")))),
        None if mass is None else mass.parse_or_warn(inertial, "the <inertial>"),
    )


def origin(element: Element, target: str, source: str | None = None) -> Transform:
    """Return the pose in the <origin> of an element, relative to `target`, or the identity if there is no <origin>.

    Raises:
        RobotDescriptionError: A value is not valid.
    """
    pose = element.one("origin")
    if pose is None:
        return Transform(target=target, source=source)
    xyz = pose.numbers("xyz", 3, _ZEROS)
    if "quat_xyzw" not in pose.attributes:
        rpy = pose.numbers("rpy", 3, _ZEROS)
        if max(map(abs, rpy)) > _MAX_ANGLE:
            pose.warn(f"rpy={' '.join(f'{angle:g}' for angle in rpy)!r} has more than one turn; angles are in radians")
        return Transform.from_rpy(xyz, rpy, target=target, source=source)
    if "rpy" in pose.attributes:
        pose.fail("<origin> has both rpy and quat_xyzw", hint="Remove one of them.")
    quaternion = pose.numbers("quat_xyzw", 4)
    if not any(quaternion):
        pose.warn("the quaternion is zero, so there is no rotation")
        quaternion = (0.0, 0.0, 0.0, 1.0)
    return Transform(xyz, quaternion, target=target, source=source)


def _geometry(element: Element) -> Geometry:
    geometry = element.required_child("geometry")
    if not geometry.children:
        geometry.fail("<geometry> contains no shape")
    shape, *others = geometry.children
    if others:
        others[0].warn(f"<geometry> contains {len(geometry.children)} shapes; the first one is used")
    if shape.tag == "mesh":
        x, y, z = shape.numbers("scale", 3, (1.0, 1.0, 1.0))
        return Mesh(shape.text("filename"), (x, y, z))
    if shape.tag == "box":
        x, y, z = shape.numbers("size", 3)
        return Box((x, y, z))
    if shape.tag == "sphere":
        return Sphere(shape.number("radius"))
    if shape.tag == "cylinder":
        return Cylinder(shape.number("radius"), shape.number("length"))
    if shape.tag == "capsule":
        return Capsule(shape.number("radius"), shape.number("length"))
    return shape.fail(f"<{shape.tag}> is not a shape", hint="The shapes are box, cylinder, capsule, sphere and mesh.")


def _inertial(element: Element, link: str) -> Inertial:
    inertia = element.required_child("inertia")
    ixx, ixy, ixz, iyy, iyz, izz = (inertia.number(component) for component in _INERTIA)
    return Inertial(
        origin(element, link), element.required_child("mass").number("value"), (ixx, ixy, ixz, iyy, iyz, izz)
    )
