"""Robots for the page: their description, checked, and the addresses of their meshes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.robots import Mesh, PackageError, Packages
from coframe.viewer.robots.meshes import MeshError, MeshTable

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from coframe.robots import Robot

__all__ = ["describe", "mesh_table"]

_MOST_PROBLEMS = 50


def mesh_table(robot: Path | None, roots: Iterable[Path]) -> MeshTable:
    """The meshes that may be fetched: those of ROS packages, and those below a robot's folder and declared ones."""
    folders = list(roots)
    packages = Packages(robot, folders)

    def find(name: str) -> Path | None:
        try:
            return packages.find(name)
        except PackageError:
            return None

    return MeshTable(find, [*folders, *([robot.resolve().parent] if robot is not None else [])])


def describe(robot: Robot, number: int, source: str, topic: str | None, meshes: MeshTable) -> dict[str, Any]:
    """The fields of a ``robot`` message.

    Args:
        robot: What was parsed.
        number: The page's number for it.
        source: Where it came from, for people.
        topic: The topic that it came from; None for a file.
        meshes: Where its meshes are.
    """
    beside = None if robot.path is None else robot.path.resolve().parent
    urls: dict[str, str] = {}
    problems: list[str] = []
    for reference in dict.fromkeys(_files_of(robot)):
        try:
            urls[reference] = meshes.url(reference, beside)
        except MeshError as error:
            problems.append(str(error))
    return {
        "id": number,
        "name": robot.name,
        "source": source,
        "urdf": robot.text,
        "meshes": urls,
        "problems": problems[:_MOST_PROBLEMS],
        "warnings": list(robot.warnings)[:_MOST_PROBLEMS],
        "joints": list(_joints_of(robot)),
        "description_topic": topic,
    }


def _files_of(robot: Robot) -> Iterator[str]:
    """The meshes and textures that it names."""
    for link in robot.links.values():
        geometries = [visual.geometry for visual in link.visuals] + [bump.geometry for bump in link.collisions]
        yield from (geometry.filename for geometry in geometries if isinstance(geometry, Mesh))
        for visual in link.visuals:
            if visual.material is not None and visual.material.texture:
                yield visual.material.texture
    for material in robot.materials.values():
        if material.texture:
            yield material.texture


def _joints_of(robot: Robot) -> Iterator[dict[str, Any]]:
    """Those that a slider moves."""
    rest = robot.zeros()
    for name in robot.free_joints:
        joint = robot.joints[name]
        limits = joint.limits if joint.type != "continuous" else None
        yield {
            "name": name,
            "type": joint.type,
            "lower": None if limits is None else limits.lower,
            "upper": None if limits is None else limits.upper,
            "value": rest[name],
        }
