# SPDX-License-Identifier: Apache-2.0
"""transforms.json of NeRF programs: Blender's scenes, instant-ngp, nerfstudio."""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import TYPE_CHECKING

import numpy as np

from coframe.calibration._values import OPENGL_TO_OPTICAL, Place, camera
from coframe.calibration.rig import Rig
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from coframe.cameras import CameraModel

__all__ = ["CONVENTION", "is_nerf", "read_nerf"]

CONVENTION = (
    "transform_matrix is the pose of the camera in the world with the axes of OpenGL and Blender (x right, y up, z "
    "backward), turned here into optical axes; the unit of the scene, here meters"
)
_OPTICAL = Transform.from_matrix(OPENGL_TO_OPTICAL)
_FISHEYE = {"OPENCV_FISHEYE", "FISHEYE"}


def is_nerf(document: Place) -> bool:
    """Return whether a JSON document contains the poses of images."""
    return "frames" in document and ("camera_angle_x" in document or any(
        isinstance(entry, dict) and "transform_matrix" in entry for entry in (document.value["frames"] or [])[:1]
    ))  # fmt: skip


def read_nerf(document: Place) -> Rig:
    """Return the rig: a frame for each image, with the name of its file, in ``world``."""
    mounts, cameras = [], dict[str, "CameraModel"]()
    shared = _camera(document, document, "camera")
    if shared is not None:
        cameras["camera"] = shared
    names: set[str] = set()
    for number, entry in enumerate(document["frames"].elements()):
        path = entry["file_path"].text() if "file_path" in entry else ""
        name = PurePosixPath(path.replace("\\", "/")).stem or f"frame_{number:05d}"
        name = name if name not in names else f"{name}_{number}"
        names.add(name)
        pose = entry["transform_matrix"].matrix() @ _OPTICAL
        mounts.append(pose.replace(target="world", source=name))
        if "fl_x" in entry and (own := _camera(entry, document, name)) is not None:
            cameras[name] = own
    return Rig(tuple(mounts), cameras, {}, "NeRF transforms.json", CONVENTION)


def _camera(entry: Place, document: Place, frame: str) -> CameraModel | None:
    """Return the camera of an entry, whose missing values are those of the document."""

    def value(key: str, default: float = 0.0) -> float:
        return next((place[key].number() for place in (entry, document) if key in place), default)

    width, height = value("w"), value("h")
    fx = value("fl_x")
    if not fx and width and value("camera_angle_x"):
        fx = width / 2.0 / np.tan(value("camera_angle_x") / 2.0)
    if not fx:
        return None
    fy = value("fl_y")
    if not fy and height and value("camera_angle_y"):
        fy = height / 2.0 / np.tan(value("camera_angle_y") / 2.0)
    kind = str(entry.value.get("camera_model", document.value.get("camera_model", "")))
    names = ("k1", "k2", "k3", "k4") if kind in _FISHEYE else ("k1", "k2", "p1", "p2", "k3")
    lens = ("equidistant" if kind in _FISHEYE else "plumb_bob", [value(name) for name in names])
    # The center of the upper left pixel is (0.5, 0.5), as in COLMAP.
    center = (value("cx", width / 2.0) - 0.5, value("cy", height / 2.0) - 0.5)
    return camera(entry, (int(width), int(height)), (fx, fy or fx, *center), lens, frame)
