# SPDX-License-Identifier: Apache-2.0
"""Models of calibrated cameras, with the API of the ROS 2 package `image_geometry`."""

from image_geometry.cameramodels import PinholeCameraModel, StereoCameraModel

__all__ = ["PinholeCameraModel", "StereoCameraModel"]
