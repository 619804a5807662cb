"""tf_tree (PyPI: transform-tree) with the chain that all contenders have, interpolated as tf2 does."""

from typing import Any

import numpy as np

from benchmarks import motion, ours
from benchmarks.motion import frame
from benchmarks.peers import package

XYZ_XYZW_FROM_WXYZ_XYZ = [4, 5, 6, 1, 2, 3, 0]
"""Columns of coframe's poses in tf_tree's."""
WXYZ_XYZ_FROM_XYZ_XYZW = [6, 3, 4, 5, 0, 1, 2]


def empty(depth: int, samples: int) -> Any:
    links = [(frame(link), frame(link + 1)) for link in range(depth)]
    return package("tf_tree").build(links, capacity=samples, interp="lerpslerp")


def filled(depth: int, samples: int = motion.SAMPLES) -> Any:
    tree = empty(depth, samples)
    for link in range(depth):
        stamps, values = ours.stamps_and_values(link, samples)
        with tree.publisher(frame(link + 1), frame(link)) as publisher:
            publisher.push_many(stamps, np.ascontiguousarray(values[:, WXYZ_XYZ_FROM_XYZ_XYZW]))
    return tree


def plan(depth: int, samples: int = motion.SAMPLES) -> Any:
    return filled(depth, samples).plan("f0", frame(depth))
