# SPDX-License-Identifier: Apache-2.0
"""Kalibr: camchain.yaml, camchain-imucam.yaml and imu.yaml."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from coframe.calibration._values import Place, camera
from coframe.calibration.rig import Rig

if TYPE_CHECKING:
    from coframe.cameras import CameraModel
    from coframe.transform.transform import Transform

__all__ = ["CONVENTION", "is_kalibr", "read_kalibr"]

CONVENTION = (
    "T_cam_imu transforms points from the IMU into the camera, and T_cn_cnm1 from the previous camera into this one; "
    "optical axes, meters, matrices by rows; timeshift_cam_imu is added to stamps of the camera for those of the IMU"
)
# The intrinsics of a model: how many parameters of the lens precede fx, fy, cx, cy, and its name.
_MODELS = {"pinhole": (0, ""), "omni": (1, "omni"), "ds": (2, "double_sphere"), "eucm": (2, "eucm")}


def is_kalibr(document: Place) -> bool:
    """Return whether a YAML document has the keys of Kalibr."""
    names = [key for key in document.value if re.fullmatch(r"(cam|imu)\d+", str(key))]
    return any("intrinsics" in document[name] or "T_i_b" in document[name] for name in names)


def read_kalibr(document: Place) -> Rig:
    """Return the rig; the frames are cam0, cam1, ... and imu."""
    names = sorted((key for key, _ in document.items() if re.fullmatch(r"cam\d+", key)), key=lambda key: int(key[3:]))
    mounts: list[Transform] = []
    offsets: dict[str, float] = {}
    cameras: dict[str, CameraModel] = {}
    for number, name in enumerate(names):
        entry = document[name]
        cameras[name] = _camera(entry, name)
        if "T_cam_imu" in entry:
            mounts.append(entry["T_cam_imu"].matrix().inverse().replace(target="imu", source=name))
        elif "T_cn_cnm1" in entry and number:
            mounts.append(entry["T_cn_cnm1"].matrix().inverse().replace(target=names[number - 1], source=name))
        if "timeshift_cam_imu" in entry:
            offsets[name] = entry["timeshift_cam_imu"].number()
    for name, entry in document.items():
        if re.fullmatch(r"imu\d+", name) and "T_i_b" in entry and name != "imu0":
            mounts.append(entry["T_i_b"].matrix().inverse().replace(target="imu", source=name))
        if re.fullmatch(r"imu\d+", name) and "time_offset" in entry:
            offsets["imu" if name == "imu0" else name] = entry["time_offset"].number()
    return Rig(tuple(mounts), cameras, offsets, "Kalibr", CONVENTION)


def _camera(entry: Place, name: str) -> CameraModel:
    kind = entry["camera_model"].text() if "camera_model" in entry else "pinhole"
    if kind not in _MODELS:
        entry["camera_model"].fail(f"is not supported: {kind[:40]!r}", f"Supported: {', '.join(_MODELS)}.")
    ahead, lens = _MODELS[kind]
    numbers = entry["intrinsics"].numbers(ahead + 4)
    own = entry["distortion_model"].text() if "distortion_model" in entry else "none"
    coefficients = entry["distortion_coeffs"].numbers() if "distortion_coeffs" in entry else ()
    size = entry["resolution"].numbers(2) if "resolution" in entry else (0, 0)
    if kind == "omni":
        distortion = [*numbers[:1], *(coefficients if own != "none" else ()), 0.0, 0.0, 0.0, 0.0][:5]
        described = (lens, distortion)
        if own not in {"none", "radtan"}:
            entry["distortion_model"].fail(f"is not supported for the model omni: {own[:40]!r}", "Supported: radtan.")
    elif ahead:
        described = (lens, [*numbers[:ahead]])
    else:
        described = (own, [*coefficients])
    return camera(entry, (int(size[0]), int(size[1])), numbers[ahead:], described, name)
