# SPDX-License-Identifier: Apache-2.0
"""Pinocchio's forward kinematics from Python, and the robot used for the comparison."""

import importlib
import importlib.metadata
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.measuring import MissingPeerError
from coframe.robots import Robot

INSTALL = "make .venv/.oracle"


def talos() -> Path:
    """Return the URDF of the humanoid talos of example-robot-data, with 60 links and 44 movable joints."""
    try:
        files = importlib.metadata.files("example-robot-data") or []
    except importlib.metadata.PackageNotFoundError:
        raise MissingPeerError(INSTALL) from None
    return next(Path(str(file.locate())) for file in files if file.name == "talos_full_v2.urdf")


class Kinematics:
    """A robot in Pinocchio.

    Args:
        path: Its URDF.
        robot: coframe's model of the robot, for the names.
        positions: Joint positions by joint, (N,).
    """

    def __init__(self, path: Path, robot: Robot, positions: dict[str, Any]) -> None:
        try:
            self.pin: Any = importlib.import_module("pinocchio")
        except ImportError:
            raise MissingPeerError(INSTALL) from None
        self.model: Any = self.pin.buildModelFromUrdf(str(path))
        self.data: Any = self.model.createData()
        self.q = np.zeros((len(next(iter(positions.values()))), self.model.nq))
        for name, values in positions.items():
            self.q[:, self.model.joints[self.model.getJointId(name)].idx_q] = values
        self.links = [self.model.getFrameId(link, self.pin.FrameType.BODY) for link in robot.frames()]

    def move(self) -> None:
        """Compute all configurations in turn; the poses of each one replace the previous ones."""
        for q in self.q:
            self.pin.forwardKinematics(self.model, self.data, q)
            self.pin.updateFramePlacements(self.model, self.data)

    def poses(self) -> Any:
        """Return the poses of all links in all configurations, (L, N, 7)."""
        rows = np.empty((len(self.links), len(self.q), 7))
        for i, q in enumerate(self.q):
            self.pin.forwardKinematics(self.model, self.data, q)
            self.pin.updateFramePlacements(self.model, self.data)
            for row, link in zip(rows, self.links, strict=True):
                row[i] = self.pin.SE3ToXYZQUAT(self.data.oMf[link])
        return rows
