# SPDX-License-Identifier: Apache-2.0
"""coframe's buffers with the chain that all contenders store."""

import numpy as np
from numpy.typing import NDArray

import coframe
from benchmarks import motion
from benchmarks.motion import frame

Stamps = NDArray[np.int64]
Values = NDArray[np.float64]


def filled(depth: int, samples: int = motion.SAMPLES) -> coframe.Buffer:
    """Return a buffer with unlimited history that contains a chain of this depth."""
    buffer = coframe.Buffer(None)
    fill(buffer, depth, samples)
    return buffer


def fill(buffer: coframe.Buffer, depth: int, samples: int = motion.SAMPLES) -> None:
    """Store the chain in a buffer."""
    for edge in range(depth):
        for index in range(samples):
            store(buffer, edge, motion.stamp(edge, index), motion.values(edge, index))


def store(
    buffer: coframe.Buffer, edge: int, stamp: int, values: tuple[float, float, float, float, float, float, float]
) -> None:
    buffer._set_values(frame(edge), frame(edge + 1), stamp, *values, False, "bench")


def stamps_and_values(edge: int, samples: int) -> tuple[Stamps, Values]:
    """Return the samples of an edge as arrays: (n,) nanoseconds; (n, 7) x, y, z, qx, qy, qz, qw."""
    stamps = np.array([motion.stamp(edge, index) for index in range(samples)], dtype=np.int64)
    return stamps, np.array([motion.values(edge, index) for index in range(samples)])


def random_times(count: int, samples: int, *, in_order: bool = False) -> Stamps:
    """Return distinct times at which every edge can be interpolated, sorted or in random order."""
    generator = np.random.default_rng(7)
    times = np.unique(generator.integers(motion.between(1), motion.between(samples - 2), size=count + count // 8))
    chosen = generator.choice(times, count, replace=False)
    return np.sort(chosen) if in_order else chosen
