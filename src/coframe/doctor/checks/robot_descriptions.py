# SPDX-License-Identifier: Apache-2.0
"""TF024: robot descriptions that are empty, invalid or have faults, and meshes that do not exist."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.formatting import count, join_names
from coframe.doctor._finding import Finding, Severity
from coframe.doctor._robot_model import parse_robot
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
    """Yield one finding per description with faults and, on the machine of the robot, one for the missing meshes."""
    last: Robot | None = None
    for number, text in enumerate(observation.descriptions):
        name = f"description {number + 1} of {len(observation.descriptions)}"
        superseded = number + 1 < len(observation.descriptions)
        later = "; a later description replaces it" if superseded else ""
        try:
            last = parse_robot(text)
        except RobotDescriptionError as error:
            empty = not text.strip() or "no link" in str(error)
            yield Finding(
                code=CODE,
                severity=Severity.NOTE if superseded else Severity.WARNING,
                text=f"{name} {'is empty' if empty else 'is invalid'}: {error}{later}",
                fix=error.hint or "Check the file that is loaded: `coframe robot FILE` names the line.",
                harm="Programs that use only the first description have no robot model." if superseded else "",
                topic=_TOPIC,
            )
        else:
            if last.warnings:
                yield Finding(
                    code=CODE,
                    severity=Severity.NOTE,
                    text=f"{name} has {count(len(last.warnings), 'fault')}: {last.warnings[0]}{later}",
                    fix="Check the file that is loaded: `coframe robot FILE` lists the faults.",
                    harm="Programs ignore faulty parts, or reject the description.",
                    topic=_TOPIC,
                )
    if last is not None and observation.live:
        yield from _missing_meshes(last)


def _missing_meshes(robot: Robot) -> Iterator[Finding]:
    packages = Packages()
    meshes = {
        shape.filename
        for link in robot.links.values()
        for shape in [*(part.geometry for part in link.visuals), *(part.geometry for part in link.collisions)]
        if isinstance(shape, Mesh)
    }
    missing = []
    for url in sorted(meshes):
        try:
            packages.resolve(url)
        except (PackageError, OSError, ValueError):
            missing.append(url)
    if missing:
        yield Finding(
            code=CODE,
            severity=Severity.NOTE,
            text=f"{len(missing)} of {len(meshes)} meshes do not exist on this machine: {join_names(missing)}",
            fix="Add the folder that contains the packages to COFRAME_PACKAGE_PATH (folders are separated as in PATH). "
            "Only visualization needs the meshes.",
            harm="Visualization tools do not show these parts of the robot; its transforms are not affected.",
            topic=_TOPIC,
        )
