# SPDX-License-Identifier: Apache-2.0
"""Conversion between messages and NumPy arrays: `numpify(message)` and `msgify(class, array)`."""

from ros2_numpy import geometry, image, occupancy_grid, point_cloud2, registry
from ros2_numpy.registry import converts_from_numpy, converts_to_numpy, msgify, numpify

__all__ = [
    "converts_from_numpy",
    "converts_to_numpy",
    "geometry",
    "image",
    "msgify",
    "numpify",
    "occupancy_grid",
    "point_cloud2",
    "registry",
]
