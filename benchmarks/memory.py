"""Prints by how many bytes a process grows for each transform that is stored: its resident memory, before and after.

    python -m benchmarks.memory coframe

Samples of ten frames are stored one by one and in turn, as they come from a robot.
"""

import os
import sys
from collections.abc import Callable
from pathlib import Path

from benchmarks import motion
from benchmarks.motion import frame

FRAMES = 10
SAMPLES = 50_000
"""Of each frame."""

Store = Callable[[int, int], object]
"""Takes a link's sample in: link, index."""


def coframe() -> Store:
    from benchmarks import ours
    from coframe import Buffer

    buffer = Buffer(None)
    return lambda link, index: ours.store(buffer, link, motion.stamp(link, index), motion.values(link, index))


def tf2() -> Store:
    from benchmarks.peers import tf2

    buffer = tf2.tf2_py.BufferCore(tf2.duration(2 * SAMPLES * motion.STEP // motion.NS))
    return lambda link, index: buffer.set_transform(tf2.message(link, index), "bench")


def tf_tree() -> Store:
    from benchmarks.peers import tf_trees

    tree = tf_trees.empty(FRAMES, SAMPLES)
    publishers = [tree.publisher(frame(link + 1), frame(link)) for link in range(FRAMES)]

    def store(link: int, index: int) -> None:
        x, y, z, qx, qy, qz, qw = motion.values(link, index)
        publishers[link].push(motion.stamp(link, index), [qw, qx, qy, qz, x, y, z])

    return store


def arrays() -> Store:
    import numpy as np

    stamps = np.empty((FRAMES, SAMPLES), dtype=np.int64)
    poses = np.empty((FRAMES, SAMPLES, 7))

    def store(link: int, index: int) -> None:
        stamps[link, index] = motion.stamp(link, index)
        poses[link, index] = motion.values(link, index)

    return store


CONTENDERS = {function.__name__: function for function in (coframe, tf2, tf_tree, arrays)}


def resident() -> int:
    return int(Path("/proc/self/statm").read_text("ascii").split()[1]) * os.sysconf("SC_PAGE_SIZE")


def main() -> None:
    contender = CONTENDERS[sys.argv[1]]
    contender()(0, 0)  # what is loaded once
    store = contender()
    before = resident()
    for index in range(SAMPLES):
        for link in range(FRAMES):
            store(link, index)
    print((resident() - before) / (FRAMES * SAMPLES))


if __name__ == "__main__":
    main()
