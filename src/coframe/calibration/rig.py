# SPDX-License-Identifier: Apache-2.0
"""Rig: the frames, transforms, cameras and time offsets of a calibration."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from coframe.buffer import Buffer
from coframe.errors import CalibrationError

if TYPE_CHECKING:
    from coframe.cameras import CameraModel
    from coframe.transform.transform import Transform

__all__ = ["Rig"]


@dataclass(frozen=True, eq=False)
class Rig:
    """A calibration in the conventions of ROS, regardless of the format of the file.

    Attributes:
        transforms: The mounts: the pose of the ``source`` (child) in the ``target`` (parent) of each, in meters.
        cameras: The cameras by name; their ``frame`` is the optical frame (REP 103), if the file has its pose.
        time_offsets: By frame of a sensor: seconds to add to its stamps for the clock of the other sensors.
        format: The name of the format from which it was read.
        convention: How the file states poses: which frame into which, axes, units, order of the quaternion.
        notes: What the file does not state, and was assumed.
    """

    transforms: tuple[Transform, ...] = ()
    cameras: dict[str, CameraModel] = field(default_factory=dict)
    time_offsets: dict[str, float] = field(default_factory=dict)
    format: str = ""
    convention: str = ""
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        children = [mount.source for mount in self.transforms]
        double = next((name for name in children if children.count(name) > 1), None)
        if double is not None and len(children) < MAX_CHECKED:
            raise CalibrationError(f"the calibration has several poses of {double!r}")

    @property
    def frames(self) -> tuple[str, ...]:
        """The names of all frames, parents first."""
        names = [name for mount in self.transforms for name in (mount.target, mount.source) if name is not None]
        return tuple(dict.fromkeys(names))

    def buffer(self) -> Buffer:
        """Return a buffer with the mounts as static transforms.

        Raises:
            CalibrationError: The mounts contain a loop.
        """
        buffer = Buffer()
        for mount in self.transforms:
            buffer.set(str(mount.target), str(mount.source), mount, static=True)
        return buffer

    def lookup(self, target: str, source: str) -> Transform:
        """Return the transform from ``source`` to ``target``, over any number of mounts.

        Raises:
            TransformException: A frame does not exist, or the frames are not connected.
        """
        return self.buffer().lookup(target, source)

    def __repr__(self) -> str:
        return f"<Rig from {self.format}: {len(self.frames)} frames, {len(self.cameras)} cameras>"


MAX_CHECKED = 2000  # mounts; the images of a reconstruction have numbers, which are unique
