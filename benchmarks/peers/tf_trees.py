# SPDX-License-Identifier: Apache-2.0
"""tf_tree (PyPI: transform-tree) with the chain that all contenders store; by default with tf2's interpolation."""

from typing import Any

import numpy as np

from benchmarks import motion, ours
from benchmarks.motion import frame
from benchmarks.peers import package

WXYZ_XYZ_FROM_XYZ_XYZW = [6, 3, 4, 5, 0, 1, 2]
"""The columns of coframe's poses in tf_tree's order."""


def empty(depth: int, samples: int, interpolation: str = "lerpslerp") -> Any:
    edges = [(frame(edge), frame(edge + 1)) for edge in range(depth)]
    return package("tf_tree").build(edges, capacity=samples, interp=interpolation)


def filled(depth: int, samples: int = motion.SAMPLES, interpolation: str = "lerpslerp") -> Any:
    tree = empty(depth, samples, interpolation)
    for edge in range(depth):
        stamps, values = ours.stamps_and_values(edge, samples)
        with tree.publisher(frame(edge + 1), frame(edge)) as publisher:
            publisher.push_many(stamps, np.ascontiguousarray(values[:, WXYZ_XYZ_FROM_XYZ_XYZW]))
    return tree


def plan(depth: int, samples: int, interpolation: str = "lerpslerp") -> Any:
    return filled(depth, samples, interpolation).plan("f0", frame(depth))
