# SPDX-License-Identifier: Apache-2.0
"""The message that describes a robot to the page, with the URLs of its meshes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._files.existence import resolved
from coframe.robots import Box, Capsule, Mesh, PackageError, Packages, Sphere
from coframe.viewer.protocol.server_messages import JointMimic, RobotJoint, RobotLink, RobotModel, RobotShape
from coframe.viewer.robots.meshes import MeshError, MeshTable

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from coframe.robots import Collision, Joint, Link, Robot, Visual
    from coframe.robots.parts import Geometry
    from coframe.viewer.protocol.common import ShapeKind

__all__ = ["make_mesh_table", "robot_message"]

_MAX_PROBLEMS = 50


def make_mesh_table(robot: Path | None, roots: Iterable[Path]) -> MeshTable:
    """Return the meshes of ROS packages, of a robot's folder and of declared folders."""
    folders = list(roots)
    packages = Packages(robot, folders)

    def find(name: str) -> Path | None:
        try:
            return packages.find(name)
        except PackageError:
            return None

    return MeshTable(find, [*folders, *([resolved(robot).parent] if robot is not None else [])])


def robot_message(robot: Robot, number: int, source: str, topic: str | None, meshes: MeshTable) -> RobotModel:
    """Return the message that describes a robot.

    Args:
        robot: The parsed description.
        number: The id of the robot.
        source: The file or topic of the description, for display.
        topic: The topic of the description, or None for a file.
        meshes: The meshes that may be fetched.
    """
    folder = None if robot.path is None else resolved(robot.path).parent
    urls: dict[str, str] = {}
    problems: list[str] = []
    for reference in dict.fromkeys(_files_of(robot)):
        try:
            urls[reference] = meshes.url(reference, folder)
        except MeshError as error:
            problems.append(str(error))
    return RobotModel(
        type="robot",
        id=number,
        name=robot.name,
        source=source,
        root=robot.root,
        links=[_link(link) for link in robot.links.values()],
        joints=list(_joints_of(robot)),
        meshes=urls,
        problems=_shorten(problems),
        warnings=_shorten(list(robot.warnings)),
        description_topic=topic,
    )


def _shorten(sentences: list[str]) -> list[str]:
    left_out = len(sentences) - _MAX_PROBLEMS
    return [*sentences[:_MAX_PROBLEMS], f"... and {left_out} more"] if left_out > 0 else sentences


def _files_of(robot: Robot) -> Iterator[str]:
    """Yield the meshes and textures of a robot."""
    for link in robot.links.values():
        geometries = [visual.geometry for visual in link.visuals]
        geometries += [collision.geometry for collision in link.collisions]
        yield from (geometry.filename for geometry in geometries if isinstance(geometry, Mesh))
        for visual in link.visuals:
            if visual.material is not None and visual.material.texture:
                yield visual.material.texture
    for material in robot.materials.values():
        if material.texture:
            yield material.texture


def _link(link: Link) -> RobotLink:
    return RobotLink(
        name=link.name,
        visuals=[_shape(visual) for visual in link.visuals],
        collisions=[_shape(collision) for collision in link.collisions],
    )


def _shape(part: Visual | Collision) -> RobotShape:
    kind, size = _kind_and_size(part.geometry)
    material = getattr(part, "material", None)
    return RobotShape(
        kind=kind,
        size=size,
        pose=part.origin.values,
        mesh=part.geometry.filename if isinstance(part.geometry, Mesh) else None,
        color=None if material is None else material.color,
        texture=None if material is None else material.texture,
    )


def _kind_and_size(geometry: Geometry) -> tuple[ShapeKind, list[float]]:
    if isinstance(geometry, Box):
        return "box", list(geometry.size)
    if isinstance(geometry, Sphere):
        return "sphere", [geometry.radius]
    if isinstance(geometry, Mesh):
        return "mesh", list(geometry.scale)
    return "capsule" if isinstance(geometry, Capsule) else "cylinder", [geometry.radius, geometry.length]


def _joints_of(robot: Robot) -> Iterator[RobotJoint]:
    """Yield the joints. Those that a slider can move have a default position."""
    defaults = robot.zeros()
    for name, joint in robot.joints.items():
        limits = joint.limits if joint.type != "continuous" else None
        yield RobotJoint(
            name=name,
            type=joint.type,
            parent=joint.parent,
            child=joint.child,
            origin=joint.origin.values,
            axis=joint.axis,
            mimic=_mimic(joint),
            lower=None if limits is None else limits.lower,
            upper=None if limits is None else limits.upper,
            effort=None if joint.limits is None else joint.limits.effort,
            value=defaults.get(name),
        )


def _mimic(joint: Joint) -> JointMimic | None:
    rule = joint.mimic
    return None if rule is None else JointMimic(joint=rule.joint, multiplier=rule.multiplier, offset=rule.offset)
