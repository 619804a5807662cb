# SPDX-License-Identifier: Apache-2.0
"""The poses of a chain at many times, implemented by hand with NumPy, SciPy and pytransform3d.

Each class receives the stamps (n,) and values (n, 7) of the edges, and returns poses (N, 7) or (N, 4, 4).
"""

import functools
import operator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.measuring import MissingPeerError
from benchmarks.motion import frame
from benchmarks.ours import Stamps, Values
from benchmarks.peers import package


class Numpy:
    """Binary search, slerp and quaternion products on arrays."""

    def __init__(self, edges: list[tuple[Stamps, Values]]) -> None:
        self._edges = edges

    def at(self, times: Stamps) -> Values:
        result = np.tile([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], (len(times), 1))
        for stamps, values in self._edges:
            step = _interpolated(stamps, values, times)
            result[:, :3] += _rotated(result[:, 3:], step[:, :3])
            result[:, 3:] = _product(result[:, 3:], step[:, 3:])
        return result


def _interpolated(stamps: Stamps, values: Values, times: Stamps) -> Values:
    after = np.clip(np.searchsorted(stamps, times, side="right"), 1, len(stamps) - 1)
    part = ((times - stamps[after - 1]) / (stamps[after] - stamps[after - 1]))[:, None]
    a, b = values[after - 1], values[after]
    cosine = np.sum(a[:, 3:] * b[:, 3:], axis=1, keepdims=True)
    angle = np.arccos(np.minimum(np.abs(cosine), 1.0))
    sine = np.maximum(np.sin(angle), 1e-300)
    near = angle < 1e-6
    before = np.where(near, 1.0 - part, np.sin((1.0 - part) * angle) / sine)
    behind = np.where(near, part, np.sin(part * angle) / sine)
    result = (1.0 - part) * a + part * b
    result[:, 3:] = before * a[:, 3:] + np.copysign(behind, cosine) * b[:, 3:]
    return result


def _rotated(q: Values, v: Values) -> Values:
    turned = 2.0 * np.cross(q[:, :3], v)
    return v + q[:, 3:] * turned + np.cross(q[:, :3], turned)


def _product(a: Values, b: Values) -> Values:
    result = np.empty_like(a)
    result[:, :3] = a[:, 3:] * b[:, :3] + b[:, 3:] * a[:, :3] + np.cross(a[:, :3], b[:, :3])
    result[:, 3] = a[:, 3] * b[:, 3] - np.sum(a[:, :3] * b[:, :3], axis=1)
    return result


class Scipy:
    """SciPy's Slerp for the rotations, NumPy for the positions, and RigidTransform for the chain."""

    def __init__(self, edges: list[tuple[Stamps, Values]]) -> None:
        self._spatial = package("scipy.spatial.transform")
        if not hasattr(self._spatial, "RigidTransform"):
            raise MissingPeerError("scipy 1.16 or newer, which needs Python 3.11")
        slerp, rotation = self._spatial.Slerp, self._spatial.Rotation
        self._edges = [
            (stamps, slerp(stamps, rotation.from_quat(values[:, 3:])), values[:, :3]) for stamps, values in edges
        ]

    def at(self, times: Stamps) -> NDArray[np.float64]:
        steps = []
        for stamps, slerp, points in self._edges:
            between = np.stack([np.interp(times, stamps, column) for column in points.T], axis=1)
            steps.append(self._spatial.RigidTransform.from_components(between, slerp(times)))
        matrices: NDArray[np.float64] = functools.reduce(operator.mul, steps).as_matrix()
        return matrices


class Pytransform3d:
    """pytransform3d's TemporalTransformManager."""

    def __init__(self, edges: list[tuple[Stamps, Values]]) -> None:
        manager = package("pytransform3d.transform_manager")
        self._manager = manager.TemporalTransformManager()
        for edge, (stamps, values) in enumerate(edges):
            seconds = stamps / 1e9
            poses = values[:, [0, 1, 2, 6, 3, 4, 5]]
            series = manager.NumpyTimeseriesTransform(seconds, poses, time_clipping=False)
            self._manager.add_transform(frame(edge + 1), frame(edge), series)
        self._source = frame(len(edges))

    def at(self, times: Stamps) -> Any:
        return self._manager.get_transform_at_time(self._source, "f0", times / 1e9)
