# SPDX-License-Identifier: Apache-2.0
"""camera_info YAML: the files that camera_calibration writes and camera_info_manager reads."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.calibration._values import camera
from coframe.calibration.rig import Rig

if TYPE_CHECKING:
    from coframe.calibration._values import Place

__all__ = ["CONVENTION", "is_camera_info", "read_camera_info"]

CONVENTION = "the camera of a CameraInfo message: OpenCV's K, D, R and P in pixels; the file contains no pose"


def is_camera_info(document: Place) -> bool:
    """Return whether a YAML document is such a file."""
    return "camera_matrix" in document and "distortion_model" in document


def read_camera_info(document: Place) -> Rig:
    """Return a rig with one camera and no frames."""
    name = document["camera_name"].text() if "camera_name" in document else "camera"
    k = document["camera_matrix"].numbers(9).reshape(3, 3)
    size = (document["image_width"].integer(), document["image_height"].integer())
    lens = (document["distortion_model"].text(), document["distortion_coefficients"].numbers())
    others = {}
    for key, field, shape in (("rectification_matrix", "r", (3, 3)), ("projection_matrix", "p", (3, 4))):
        if key in document:
            others[field] = document[key].numbers(int(np.prod(shape))).reshape(shape)
    return Rig(
        cameras={name: camera(document, size, k[[0, 1, 0, 1], [0, 1, 2, 2]], lens, name, others)},
        format="camera_info YAML",
        convention=CONVENTION,
    )
