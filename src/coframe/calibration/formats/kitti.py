# SPDX-License-Identifier: Apache-2.0
"""KITTI: calib_cam_to_cam.txt, calib_velo_to_cam.txt, calib_imu_to_velo.txt (raw data), calib.txt (odometry)."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from coframe.calibration._values import Place, camera
from coframe.calibration.rig import Rig
from coframe.errors import CalibrationError
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.cameras import CameraModel

__all__ = ["CONVENTION", "is_kitti", "kitti_text", "parse_kitti", "read_kitti"]

CONVENTION = (
    "R and T (Tr) transform points: from velo into cam0, from imu into velo, and from cam0 into camera xx; "
    "P of odometry projects points of the rectified cam0; optical axes, meters"
)
_MAX_TURN = 1e-6  # of the axes of rectified cameras
_LINE = re.compile(r"(\w+):?\s+(.*)")


def parse_kitti(text: str, file: str) -> Place:
    """Return the lines `name: numbers` of a file as a document."""
    found: dict[str, object] = {}
    for line in text.splitlines():
        match = _LINE.fullmatch(line.strip())
        if match:
            try:
                found[match[1]] = [float(number) for number in match[2].split()]
            except ValueError:
                found[match[1]] = match[2]
    return Place(found, file)


def is_kitti(document: Place) -> bool:
    """Return whether a document has the lines of one of the files."""
    names = set(document.value)
    return (
        ({"R", "T"} <= names) or "P0" in names or "P2" in names or any(re.fullmatch(r"P_rect_\d\d", n) for n in names)
    )


def read_kitti(documents: list[Place]) -> Rig:
    """Return the rig of one or several files; the frames are imu, velo, cam0, cam1, ..."""
    mounts: list[Transform] = []
    cameras: dict[str, CameraModel] = {}
    notes: list[str] = []
    for document in documents:
        if {"R", "T"} <= set(document.value):
            mounts.append(_mount_between(document))
        elif any(re.fullmatch(r"P_rect_\d\d", name) for name in document.value):
            _read_raw_cameras(document, mounts, cameras)
        else:
            _read_odometry(document, mounts, cameras, notes)
    return Rig(tuple(mounts), cameras, {}, "KITTI", CONVENTION, tuple(notes))


def _mount_between(document: Place) -> Transform:
    """Return the mount in a file of R and T, whose frames are in the name of the file."""
    motion = document["R"].rigid(document["R"].numbers(9).reshape(3, 3), document["T"].numbers(3))
    match = re.search(r"(imu|velo)_to_(velo|cam)", document.file)
    if not match:
        document.fail("does not name its frames: the name of the file must contain velo_to_cam or imu_to_velo")
    names = {"imu": "imu", "velo": "velo", "cam": "cam0"}
    return motion.inverse().replace(target=names[match[1]], source=names[match[2]])


def _read_raw_cameras(document: Place, mounts: list[Transform], cameras: dict[str, CameraModel]) -> None:
    for name, place in document.items():
        if not (match := re.fullmatch(r"K_(\d\d)", name)):
            continue
        number = match[1]
        frame = f"cam{int(number)}"
        k = place.numbers(9).reshape(3, 3)
        size = document[f"S_{number}"].numbers(2)
        # The rectified images have their own size, R and P.
        others = {"r": document[f"R_rect_{number}"].numbers(9).reshape(3, 3),
                  "p": document[f"P_rect_{number}"].numbers(12).reshape(3, 4)}  # fmt: skip
        lens = ("plumb_bob", document[f"D_{number}"].numbers(5))
        cameras[frame] = camera(place, (int(size[0]), int(size[1])), k[[0, 1, 0, 1], [0, 1, 2, 2]], lens, frame, others)
        if int(number):
            turn, at = document[f"R_{number}"].numbers(9).reshape(3, 3), document[f"T_{number}"]
            motion = at.rigid(turn, at.numbers(3))
            mounts.append(motion.inverse().replace(target="cam0", source=frame))


def _read_odometry(document: Place, mounts: list[Transform], cameras: dict[str, CameraModel], notes: list[str]) -> None:
    for name, place in document.items():
        if not (match := re.fullmatch(r"P(\d)", name)):
            continue
        p = place.numbers(12).reshape(3, 4)
        frame = f"cam{match[1]}"
        own = np.column_stack([p[:, :3], np.zeros(3)])
        cameras[frame] = camera(place, (0, 0), p[[0, 1, 0, 1], [0, 1, 2, 2]], ("", ()), frame, {"p": own})
        if frame != "cam0":
            shift = np.linalg.solve(p[:, :3], p[:, 3])
            mounts.append(place.rigid(np.eye(3), np.asarray(-shift, np.float64)).replace(target="cam0", source=frame))
    for key, target, source in (("Tr", "velo", "cam0"), ("Tr_velo_to_cam", "velo", "cam0"),
                                ("Tr_velo_cam", "velo", "cam0"), ("Tr_imu_to_velo", "imu", "velo")):  # fmt: skip
        if key in document:
            motion = document[key].matrix()
            if key == "Tr_velo_to_cam" and "R0_rect" in document:  # cam0 of this file is rectified
                rectify = document["R0_rect"].numbers(9).reshape(3, 3)
                motion = document["R0_rect"].rigid(rectify, np.zeros(3)) @ motion
            mounts.append(motion.inverse().replace(target=target, source=source))
    notes.append("the file contains no image size; its images are rectified")


def kitti_text(rig: Rig) -> str:
    """Return calib.txt of odometry: the cameras in their order, and Tr if there is a frame velo.

    Raises:
        CalibrationError: A camera is not rectified, or turned relative to the first one.
    """
    if not rig.cameras:
        raise CalibrationError("calib.txt of KITTI needs cameras, and the calibration has none")
    lines, first = list[str](), next(iter(rig.cameras.values())).frame
    for number, (name, model) in enumerate(rig.cameras.items()):
        if any(model.lens.coefficients):
            raise CalibrationError(
                f"calib.txt of KITTI has rectified cameras only, and {name} has a distortion",
                hint="Rectify the images, and write the calibration of the rectified cameras.",
            )
        pose = rig.lookup(first, model.frame) if number else Transform()
        if np.abs(pose.matrix[:3, :3] - np.eye(3)).max() > _MAX_TURN:
            raise CalibrationError(f"calib.txt of KITTI has parallel cameras only, and {name} is turned")
        p = np.column_stack([model.k, -model.k @ pose.translation])
        lines.append(f"P{number}: {_words(p)}")
    if "velo" in rig.frames:
        lines.append(f"Tr: {_words(rig.lookup(first, 'velo').matrix[:3])}")
    return "\n".join([*lines, ""])


def _words(matrix: NDArray[np.float64]) -> str:
    return " ".join(repr(float(value) + 0.0) for value in matrix.ravel())
