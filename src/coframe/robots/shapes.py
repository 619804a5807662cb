# SPDX-License-Identifier: Apache-2.0
"""Parsing of links in URDF: visuals, collisions, materials and inertia."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.errors import InvalidArgumentException
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
from coframe.transform import Transform

if TYPE_CHECKING:
    from coframe.robots.document import Element

__all__ = ["Materials", "origin", "parse_link"]

_ZEROS = (0.0, 0.0, 0.0)
_INERTIA = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


class Materials:
    """The materials that a description defines, at the top level or in links. Undefined ones cause warnings."""

    def __init__(self, root: Element, warnings: list[str]) -> None:
        self.defined: dict[str, Material] = {}
        self.warnings = warnings
        for element in root.all("material"):
            material = _material(element)
            if self.defined.setdefault(element.text("name"), material) != material:
                element.fail(f"material {material.name!r} is defined twice with different values")
        for link in root.all("link"):
            for visual in link.all("visual"):
                for element in filter(_defines, visual.all("material")):
                    material = _material(element)
                    self.defined.setdefault(material.name, material)

    def used_in(self, visual: Element) -> Material | None:
        """Return the material of a visual; None if it has none."""
        element = visual.one("material")
        if element is None:
            return None
        if _defines(element):
            return _material(element)
        name = element.attributes.get("name", "").strip()
        if name and name not in self.defined:
            self.warnings.append(f"line {element.line}: material {name!r} is not defined")
        return self.defined.get(name)


def _defines(element: Element) -> bool:
    return bool(element.children)


def _material(element: Element) -> Material:
    color, texture = element.one("color"), element.one("texture")
    rgba = None
    if color is not None:
        r, g, b, a = color.numbers("rgba", 4)
        rgba = (r, g, b, a)
    filename = None if texture is None else texture.attributes.get("filename", "").strip() or None
    return Material(element.attributes.get("name", "").strip(), rgba, filename)


def parse_link(element: Element, materials: Materials) -> Link:
    """Return the link that a <link> element describes.

    Raises:
        RobotDescriptionError: A value is missing or is not a number.
    """
    name = element.text("name")
    visuals = tuple(
        Visual(visual.attributes.get("name", ""), origin(visual, name), _geometry(visual), materials.used_in(visual))
        for visual in element.all("visual")
    )
    collisions = tuple(
        Collision(collision.attributes.get("name", ""), origin(collision, name), _geometry(collision))
        for collision in element.all("collision")
    )
    return Link(name, visuals, collisions, _inertial(element, name))


def origin(element: Element, target: str, source: str | None = None) -> Transform:
    """Return the pose in the <origin> of an element, relative to `target`; the identity if there is no <origin>.

    Raises:
        RobotDescriptionError: A value is not valid.
    """
    pose = element.one("origin")
    if pose is None:
        return Transform(target=target, source=source)
    xyz = pose.numbers("xyz", 3, _ZEROS)
    if "quat_xyzw" not in pose.attributes:
        return Transform.from_rpy(xyz, pose.numbers("rpy", 3, _ZEROS), target=target, source=source)
    if "rpy" in pose.attributes:
        pose.fail("<origin> has both rpy and quat_xyzw", hint="Remove one of them.")
    try:
        return Transform(xyz, pose.numbers("quat_xyzw", 4), target=target, source=source)
    except InvalidArgumentException as error:
        pose.fail(str(error), hint=error.hint)


def _geometry(element: Element) -> Geometry:
    geometry = element.need("geometry")
    if len(geometry.children) != 1:
        geometry.fail(f"<geometry> must contain one shape, not {len(geometry.children)}")
    shape = geometry.children[0]
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


def _inertial(link: Element, name: str) -> Inertial | None:
    element = link.one("inertial")
    if element is None:
        return None
    inertia = element.need("inertia")
    ixx, ixy, ixz, iyy, iyz, izz = (inertia.number(component) for component in _INERTIA)
    return Inertial(origin(element, name), element.need("mass").number("value"), (ixx, ixy, ixz, iyy, iyz, izz))
