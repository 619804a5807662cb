"""coframe's buffers with the chain that all contenders have."""

import numpy as np
from numpy.typing import NDArray

import coframe
from benchmarks import motion
from benchmarks.motion import frame

Stamps = NDArray[np.int64]
Values = NDArray[np.float64]


def filled(depth: int, samples: int = motion.SAMPLES) -> coframe.Buffer:
    """A buffer that keeps everything, with a chain that is so deep."""
    buffer = coframe.Buffer(None)
    for link in range(depth):
        for index in range(samples):
            store(buffer, link, motion.stamp(link, index), motion.values(link, index))
    return buffer


def store(
    buffer: coframe.Buffer, link: int, stamp: int, values: tuple[float, float, float, float, float, float, float]
) -> None:
    buffer._set_values(frame(link), frame(link + 1), stamp, *values, False, "bench")


def stamps_and_values(link: int, samples: int) -> tuple[Stamps, Values]:
    """A link's samples as arrays: (n,) nanoseconds; (n, 7) x, y, z, qx, qy, qz, qw."""
    stamps = np.array([motion.stamp(link, index) for index in range(samples)], dtype=np.int64)
    return stamps, np.array([motion.values(link, index) for index in range(samples)])


def random_times(count: int, samples: int, *, in_order: bool = False) -> Stamps:
    """Distinct times at which every link can be interpolated, in random order or not."""
    generator = np.random.default_rng(7)
    times = np.unique(generator.integers(motion.between(1), motion.between(samples - 2), size=count + count // 8))
    chosen = generator.choice(times, count, replace=False)
    return np.sort(chosen) if in_order else chosen
