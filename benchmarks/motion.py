# SPDX-License-Identifier: Apache-2.0
"""The chain that all contenders store: f0 <- f1 <- f2 ...; all edges rotate, at 50 Hz, each with its own stamps."""

import math

NS = 1_000_000_000
STEP = 20_000_000
START = 1_000 * NS
SAMPLES = 500
"""Ten seconds, the default cache time of tf2."""

_LATER = 1_300_000
_RADIANS_PER_STEP = 0.02


def frame(depth: int) -> str:
    return f"f{depth}"


def stamp(edge: int, index: int) -> int:
    """Return the stamp of a sample of an edge; edges do not publish at the same times."""
    return START + index * STEP + edge * _LATER % STEP


def between(index: int) -> int:
    """Return a time near the samples of an index at which every edge has to be interpolated."""
    return START + index * STEP + STEP // 2 + 1


def values(edge: int, index: int) -> tuple[float, float, float, float, float, float, float]:
    """Return x, y, z and the quaternion x, y, z, w of a sample of an edge."""
    half = 0.5 * (_RADIANS_PER_STEP * index + edge)
    axis = (0.0, 0.6, 0.8) if edge % 2 else (0.8, 0.0, 0.6)
    turn = math.sin(half)
    x, y, z = (part * turn for part in axis)
    return 0.1 * edge + 0.001 * index, 0.2, 0.3, x, y, z, math.cos(half)
