# SPDX-License-Identifier: Apache-2.0
"""Calibrated cameras: project points into images, and pixels back to rays."""

from coframe.cameras.camera_model import CameraModel
from coframe.cameras.coloring import PointColors, color_points
from coframe.cameras.image_topics import camera_info_topic, is_rectified_topic
from coframe.cameras.lenses import Lens
from coframe.cameras.model_names import LENS_NAMES, lens_of
from coframe.errors import CameraError

__all__ = [
    "LENS_NAMES",
    "CameraError",
    "CameraModel",
    "Lens",
    "PointColors",
    "camera_info_topic",
    "color_points",
    "is_rectified_topic",
    "lens_of",
]
