"""What all contenders store: a chain f0 <- f1 <- f2 ..., every link turning at 50 Hz, each link at times of its own."""

import math

NS = 1_000_000_000
STEP = 20_000_000
START = 1_000 * NS
SAMPLES = 500
"""Ten seconds, as a tf2 buffer keeps by default."""

_LATER = 1_300_000
_RADIANS_PER_STEP = 0.02


def frame(depth: int) -> str:
    return f"f{depth}"


def stamp(link: int, index: int) -> int:
    """When a link's sample was taken: links do not publish at the same time."""
    return START + index * STEP + link * _LATER % STEP


def between(index: int) -> int:
    """A time near the samples of this number at which no link has one, so that every link is interpolated."""
    return START + index * STEP + STEP // 2 + 1


def values(link: int, index: int) -> tuple[float, float, float, float, float, float, float]:
    """x, y, z and the quaternion x, y, z, w of a link's sample."""
    half = 0.5 * (_RADIANS_PER_STEP * index + link)
    axis = (0.0, 0.6, 0.8) if link % 2 else (0.8, 0.0, 0.6)
    turn = math.sin(half)
    x, y, z = (part * turn for part in axis)
    return 0.1 * link + 0.001 * index, 0.2, 0.3, x, y, z, math.cos(half)
