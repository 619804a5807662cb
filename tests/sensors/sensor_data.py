# SPDX-License-Identifier: Apache-2.0
"""Test data: point clouds and a moving sensor."""

from array import array

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

import coframe
from coframe.messages import find

SECOND = 1_000_000_000
START = 1_700_000_000 * SECOND
PERIOD = SECOND // 100
SAMPLES = 50

DATATYPES = {"i1": 1, "u1": 2, "i2": 3, "u2": 4, "i4": 5, "u4": 6, "f4": 7, "f8": 8}


def message_of(points, *, frame="lidar", stamp=START, row_padding=0, big_endian=False):
    """Return a PointCloud2 from a structured array with one or two axes and any layout."""
    cloud = find("sensor_msgs/msg/PointCloud2")()
    field_class = find("sensor_msgs/msg/PointField")
    cloud.header.frame_id = frame
    cloud.header.stamp.sec, cloud.header.stamp.nanosec = divmod(stamp, SECOND)
    rows = np.atleast_2d(points)
    cloud.height, cloud.width = rows.shape
    for name in points.dtype.names:
        kind, offset = points.dtype.fields[name][:2]
        cloud.fields.append(field_class(name=name, offset=offset, datatype=DATATYPES[kind.str[1:]], count=1))
    cloud.is_bigendian = big_endian
    cloud.point_step = points.dtype.itemsize
    cloud.row_step = rows.shape[1] * cloud.point_step + row_padding
    if big_endian:
        rows = rows.astype(points.dtype.newbyteorder(">"))
    cloud.data = array("B", b"".join(row.tobytes() + b"\xee" * row_padding for row in rows))
    cloud.is_dense = True
    return cloud


def array_of(cloud):
    """Return the points of a message, read independently: shape (height, width)."""
    kinds = {number: kind for kind, number in DATATYPES.items()}
    order = ">" if cloud.is_bigendian else "<"
    dtype = np.dtype(
        {
            "names": [field.name for field in cloud.fields],
            "formats": [order + kinds[field.datatype] for field in cloud.fields],
            "offsets": [field.offset for field in cloud.fields],
            "itemsize": cloud.point_step,
        }
    )
    rows = np.frombuffer(cloud.data, np.uint8)[: cloud.height * cloud.row_step].reshape(cloud.height, -1)
    used = np.ascontiguousarray(rows[:, : cloud.width * cloud.point_step])
    return used.view(dtype)


def xyz(points, names=("x", "y", "z")):
    """Return three fields of a structured array as float64, shape (..., 3)."""
    return np.stack([points[name] for name in names], axis=-1).astype(np.float64)


class Motion:
    """A sensor with random poses in `odom`; SciPy interpolates between them."""

    def __init__(self, seed=3, samples=SAMPLES):
        self.rotations = Rotation.random(samples, random_state=seed)
        self.translations = np.random.default_rng(seed).normal(size=(samples, 3))
        self.stamps = START + PERIOD * np.arange(samples)
        self.first, self.last = int(self.stamps[0]), int(self.stamps[-1])

    def fill(self, buffer, parent="odom", child="lidar"):
        for stamp, translation, rotation in zip(self.stamps, self.translations, self.rotations, strict=True):
            transform = coframe.Transform(translation, rotation.as_quat())
            buffer.set(parent, child, transform, int(stamp))
        return self

    def at(self, times):
        """Return rotations, and translations of shape (N, 3)."""
        seconds = (np.asarray(times) - self.first) / SECOND
        known = (self.stamps - self.first) / SECOND
        moved = np.stack([np.interp(seconds, known, column) for column in self.translations.T], axis=1)
        return Slerp(known, self.rotations)(seconds), moved

    def apply(self, times, points):
        rotations, translations = self.at(times)
        return rotations.apply(points) + translations
