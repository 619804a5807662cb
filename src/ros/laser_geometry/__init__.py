# SPDX-License-Identifier: Apache-2.0
"""Conversion of laser scans to point clouds, with the API of the ROS 2 package `laser_geometry`."""

from laser_geometry.laser_geometry import LaserProjection

__all__ = ["LaserProjection"]
