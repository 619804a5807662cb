"""tf_tree (PyPI: transform-tree) with the chain that all contenders have; interpolated as tf2 does, by default."""

from typing import Any

import numpy as np

from benchmarks import motion, ours
from benchmarks.motion import frame
from benchmarks.peers import package

WXYZ_XYZ_FROM_XYZ_XYZW = [6, 3, 4, 5, 0, 1, 2]
"""Where tf_tree's columns of a pose are in ours."""


def empty(depth: int, samples: int, interpolation: str = "lerpslerp") -> Any:
    links = [(frame(link), frame(link + 1)) for link in range(depth)]
    return package("tf_tree").build(links, capacity=samples, interp=interpolation)


def filled(depth: int, samples: int = motion.SAMPLES, interpolation: str = "lerpslerp") -> Any:
    tree = empty(depth, samples, interpolation)
    for link in range(depth):
        stamps, values = ours.stamps_and_values(link, samples)
        with tree.publisher(frame(link + 1), frame(link)) as publisher:
            publisher.push_many(stamps, np.ascontiguousarray(values[:, WXYZ_XYZ_FROM_XYZ_XYZW]))
    return tree


def plan(depth: int, samples: int, interpolation: str = "lerpslerp") -> Any:
    return filled(depth, samples, interpolation).plan("f0", frame(depth))
