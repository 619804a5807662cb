# SPDX-License-Identifier: Apache-2.0
"""The message that describes a robot to the page, with the URLs of its meshes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.existence import resolved
from coframe.robots import Mesh, PackageError, Packages
from coframe.viewer.protocol.server_messages import Robot as RobotMessage
from coframe.viewer.protocol.server_messages import RobotJoint
from coframe.viewer.robots.meshes import MeshError, MeshTable

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from coframe.robots import Robot

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


def robot_message(robot: Robot, number: int, source: str, topic: str | None, meshes: MeshTable) -> RobotMessage:
    """Return the message that describes a robot.

    Args:
        robot: The parsed description.
        number: The id of the robot.
        source: The file or topic of the description, for display.
        topic: The topic of the description; None for a file.
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
    return RobotMessage(
        type="robot",
        id=number,
        name=robot.name,
        source=source,
        urdf=robot.text,
        meshes=urls,
        problems=_shortened(problems),
        warnings=_shortened(list(robot.warnings)),
        joints=list(_joints_of(robot)),
        description_topic=topic,
    )


def _shortened(sentences: list[str]) -> list[str]:
    left_out = len(sentences) - _MAX_PROBLEMS
    return [*sentences[:_MAX_PROBLEMS], f"... and {left_out} more"] if left_out > 0 else sentences


def _files_of(robot: Robot) -> Iterator[str]:
    """Yield the meshes and textures that a robot names."""
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


def _joints_of(robot: Robot) -> Iterator[RobotJoint]:
    """Yield the joints that a slider can move."""
    rest = robot.zeros()
    for name in robot.free_joints:
        joint = robot.joints[name]
        limits = joint.limits if joint.type != "continuous" else None
        yield RobotJoint(
            name=name,
            type=joint.type,
            lower=None if limits is None else limits.lower,
            upper=None if limits is None else limits.upper,
            value=rest[name],
        )
