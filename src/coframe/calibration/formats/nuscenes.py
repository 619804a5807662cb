# SPDX-License-Identifier: Apache-2.0
"""nuScenes: calibrated_sensor.json, with sensor.json next to it."""

from __future__ import annotations

import hashlib
import json
from typing import TYPE_CHECKING

import numpy as np

from coframe.calibration._values import camera
from coframe.calibration.rig import Rig
from coframe.errors import CalibrationError

if TYPE_CHECKING:
    from coframe.calibration._values import Place
    from coframe.cameras import CameraModel

__all__ = ["CONVENTION", "is_nuscenes", "nuscenes_files", "read_nuscenes"]

CONVENTION = (
    "the pose of the sensor in the ego vehicle (the middle of the rear axle): meters, quaternion w, x, y, z; cameras "
    "have optical axes"
)
_IMAGE_SIZE = (1600, 900)  # of all cameras of nuScenes; the file does not state it


def is_nuscenes(document: Place) -> bool:
    """Return whether a JSON document is a list of calibrated sensors."""
    value = document.value
    return isinstance(value, list) and bool(value) and isinstance(value[0], dict) and "sensor_token" in value[0]


def read_nuscenes(document: Place, sensors: Place | None) -> Rig:
    """Return the rig; a channel with several poses gives frames with a part of their tokens."""
    channels = {}
    if sensors is not None:
        channels = {entry["token"].text(): entry["channel"].text() for entry in sensors.elements()}
    entries = document.elements()
    names = [channels.get(token := entry["sensor_token"].text(), token[:8]) for entry in entries]
    mounts, cameras = [], dict[str, "CameraModel"]()
    for name, entry in zip(names, entries, strict=True):
        frame = name if names.count(name) == 1 else f"{name}/{entry['token'].text()[:8]}"
        pose = entry.pose(entry["translation"].numbers(3), np.roll(entry["rotation"].numbers(4), -1))
        mounts.append(pose.replace(target="ego", source=frame))
        if "camera_intrinsic" in entry and entry["camera_intrinsic"].numbers().size:
            place = entry["camera_intrinsic"]
            k = place.numbers(9).reshape(3, 3)
            cameras[frame] = camera(place, _IMAGE_SIZE, k[[0, 1, 0, 1], [0, 1, 2, 2]], ("", ()), frame)
    return Rig(tuple(mounts), cameras, {}, "nuScenes", CONVENTION)


def nuscenes_files(rig: Rig) -> dict[str, str]:
    """Return calibrated_sensor.json and sensor.json; the first frame of the rig is the ego vehicle.

    Raises:
        CalibrationError: A camera has a distortion, which the format does not have.
    """
    cameras = {model.frame: model for model in rig.cameras.values()}
    if not rig.frames:
        raise CalibrationError("calibrated_sensor.json of nuScenes needs poses, and the calibration has none")
    ego, *frames = rig.frames
    entries, sensors, buffer = [], [], rig.buffer()
    for frame in frames:
        model = cameras.get(frame)
        if model is not None and any(model.lens.coefficients):
            raise CalibrationError(f"nuScenes has no distortion, and the camera of {frame} has one: rectify its images")
        pose = buffer.lookup(ego, frame)
        token, sensor = (hashlib.md5(f"{kind}/{frame}".encode(), usedforsecurity=False).hexdigest() for kind in "cs")
        sensors.append({"token": sensor, "channel": frame, "modality": _modality(frame, model)})
        entries.append({
            "token": token, "sensor_token": sensor, "translation": pose.translation.tolist(),
            "rotation": np.roll(pose.quaternion, 1).tolist(),
            "camera_intrinsic": [] if model is None else model.k.tolist(),
        })  # fmt: skip
    files = {"calibrated_sensor.json": entries, "sensor.json": sensors}
    return {name: json.dumps(document, indent=1) + "\n" for name, document in files.items()}


def _modality(frame: str, model: CameraModel | None) -> str:
    if model is not None:
        return "camera"
    return next((word for word in ("radar", "imu") if word in frame.lower()), "lidar")
