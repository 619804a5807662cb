# SPDX-License-Identifier: Apache-2.0
"""Conversion between image messages and the arrays of OpenCV, with the API of the ROS 2 package `cv_bridge`.

OpenCV itself is needed only for color conversion and compressed images.
"""

from cv_bridge.boost.cv_bridge_boost import cvtColorForDisplay, getCvType
from cv_bridge.core import CvBridge, CvBridgeError

__all__ = ["CvBridge", "CvBridgeError", "cvtColorForDisplay", "getCvType"]
