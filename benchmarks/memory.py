# SPDX-License-Identifier: Apache-2.0
"""Prints by how many bytes the resident memory of a process grows for each stored transform.

    python -m benchmarks.memory coframe

Samples of ten frames are stored one by one and in turn, as a listener of a robot stores them.
"""

import os
import sys
from collections.abc import Callable
from pathlib import Path

from benchmarks import motion
from benchmarks.motion import frame

FRAMES = 10
SAMPLES = 50_000
"""Number of samples of each frame."""

Store = Callable[[int, int], object]
"""Stores a sample; the arguments are the edge and the index."""


def coframe() -> Store:
    from benchmarks import ours
    from coframe import Buffer

    buffer = Buffer(None)
    return lambda edge, index: ours.store(buffer, edge, motion.stamp(edge, index), motion.values(edge, index))


def tf2() -> Store:
    from benchmarks.peers import tf2

    buffer = tf2.tf2_py.BufferCore(tf2.duration(2 * SAMPLES * motion.STEP // motion.NS))
    return lambda edge, index: buffer.set_transform(tf2.message(edge, index), "bench")


def tf_tree() -> Store:
    from benchmarks.peers import tf_trees

    tree = tf_trees.empty(FRAMES, SAMPLES)
    publishers = [tree.publisher(frame(edge + 1), frame(edge)) for edge in range(FRAMES)]

    def store(edge: int, index: int) -> None:
        x, y, z, qx, qy, qz, qw = motion.values(edge, index)
        publishers[edge].push(motion.stamp(edge, index), [qw, qx, qy, qz, x, y, z])

    return store


def arrays() -> Store:
    import numpy as np

    stamps = np.empty((FRAMES, SAMPLES), dtype=np.int64)
    poses = np.empty((FRAMES, SAMPLES, 7))

    def store(edge: int, index: int) -> None:
        stamps[edge, index] = motion.stamp(edge, index)
        poses[edge, index] = motion.values(edge, index)

    return store


CONTENDERS = {function.__name__: function for function in (coframe, tf2, tf_tree, arrays)}


def resident() -> int:
    return int(Path("/proc/self/statm").read_text("ascii").split()[1]) * os.sysconf("SC_PAGE_SIZE")


def main() -> None:
    contender = CONTENDERS[sys.argv[1]]
    contender()(0, 0)  # Loads everything that is loaded once.
    store = contender()
    before = resident()
    for index in range(SAMPLES):
        for edge in range(FRAMES):
            store(edge, index)
    print((resident() - before) / (FRAMES * SAMPLES))


if __name__ == "__main__":
    main()
