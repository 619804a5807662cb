"""TF024: robot descriptions that are empty or broken, and meshes that are not there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.phrases import listed
from coframe.doctor.robot_model import parsed
from coframe.errors import PackageError, RobotDescriptionError
from coframe.robots import Mesh, Packages

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation
    from coframe.robots import Robot

__all__ = ["CODE", "find"]

CODE = "TF024"
_TOPIC = "/robot_description"


def find(observation: Observation) -> Iterator[Finding]:
    """One finding a description, and one for the meshes of the last one, on the machine where it runs."""
    last: Robot | None = None
    for number, text in enumerate(observation.descriptions):
        which = f"description {number + 1} of {len(observation.descriptions)}"
        superseded = number + 1 < len(observation.descriptions)
        severity = Severity.NOTE if superseded else Severity.WARNING
        later = "; another one came after it" if superseded else ""
        try:
            last = parsed(text)
        except RobotDescriptionError as error:
            empty = not text.strip() or "no link" in str(error)
            yield Finding(
                code=CODE,
                severity=severity,
                text=f"{which} {'is empty' if empty else 'is broken'}: {error}{later}",
                fix=error.hint or "Check the file that is loaded: check_urdf FILE, or coframe robot FILE.",
                harm="Programs that keep the first description that they are given have no robot."
                if superseded
                else "",
                topic=_TOPIC,
            )
    if last is not None and observation.live:
        yield from _meshes(last)


def _meshes(robot: Robot) -> Iterator[Finding]:
    packages = Packages()
    shapes = {
        shape.filename
        for link in robot.links.values()
        for shape in [*(part.geometry for part in link.visuals), *(part.geometry for part in link.collisions)]
        if isinstance(shape, Mesh)
    }
    missing = []
    for url in sorted(shapes):
        try:
            packages.resolve(url)
        except (PackageError, OSError, ValueError):
            missing.append(url)
    if missing:
        yield Finding(
            code=CODE,
            severity=Severity.NOTE,
            text=f"{len(missing)} of {len(shapes)} meshes are not found on this machine: {listed(missing)}",
            fix="Source the workspace that has the packages, or name their folder in ROS_PACKAGE_PATH; only "
            "displays need "
            "them.",
            harm="Displays leave these parts of the robot out; its transforms are right all the same.",
            topic=_TOPIC,
        )
