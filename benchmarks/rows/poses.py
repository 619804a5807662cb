# SPDX-License-Identifier: Apache-2.0
"""Operations of SE(3) on batches of poses, without a buffer."""

from collections.abc import Callable, Generator
from typing import Any

import numpy as np

from benchmarks.measuring import Contender, Row, Target, TimesAsFast
from benchmarks.peers import lie
from benchmarks.rows.batch import batch
from coframe import Transform

MANY, THEIRS = 100_000, 1_000
"""Poses per call of libraries with batches, and per sample of Pinocchio, which computes them one by one."""


def values(count: int) -> tuple[Any, Transform, Transform, Any]:
    """Return twists, two batches of poses, and fractions."""
    rng = np.random.default_rng(4)
    twists = rng.uniform(-1.5, 1.5, (count, 6))
    return twists, Transform.exp(twists), Transform.exp(twists[::-1]), rng.uniform(0, 1, count)


def row(operation: str, peer: Callable[..., Any], reference: str, target: Target | None = None) -> Row:
    def contenders() -> Generator[Contender]:
        count = THEIRS if peer is lie.Pinocchio else MANY
        other, same = peer(*values(count)), lie.Ours(*values(count))
        ours, theirs = (each.matrices(each.operations[operation]())[:100] for each in (same, other))
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-9)
        yield batch("run()", MANY, run=lie.Ours(*values(MANY)).operations[operation])
        yield batch("run()", count, run=other.operations[operation])

    return Row(f"{operation}, N=1e5, each", reference, contenders, target)


SCIPY, PYTRANSFORM3D, JAXLIE, PINOCCHIO = "SciPy", "pytransform3d", "jaxlie on the CPU", "Pinocchio in a loop"
BASIC = ("exp", "log", "compose")
SCREWS = "interpolate along screws"

ROWS = [
    *(row(name, lie.Scipy, SCIPY, TimesAsFast(4)) for name in (*BASIC, "inverse", "interpolate")),
    *(row(name, lie.Pytransform3d, PYTRANSFORM3D, TimesAsFast(2)) for name in (*BASIC, SCREWS)),
    *(row(name, lie.Jaxlie, JAXLIE, TimesAsFast(5)) for name in BASIC),
    *(row(name, lie.Pinocchio, PINOCCHIO, TimesAsFast(10)) for name in (*BASIC, SCREWS)),
]
