# SPDX-License-Identifier: Apache-2.0
"""Forward kinematics of a robot, for many configurations in one call and for a single one."""

from collections.abc import Generator
from typing import Any

import numpy as np

from benchmarks.measuring import Contender, Row, Target, TimesAsFast
from benchmarks.peers import pinocchio
from benchmarks.rows.batch import batch
from benchmarks.statement import Statement
from coframe.robots import load

MANY, THEIRS = 100_000, 1_000
"""Configurations per call of coframe, and per sample of Pinocchio, which computes them one by one."""


def contenders(ours: str, theirs: str, count: int, their_count: int) -> Generator[Contender]:
    """Yield the two statements, which can use `robot`, `positions` and `out`, or `other`."""
    path = pinocchio.talos()
    robot = load(path)
    rng = np.random.default_rng(1)
    moving = [name for name, joint in robot.joints.items() if joint.size]
    positions = {name: rng.uniform(-np.pi, np.pi, max(count, their_count)) for name in moving}
    given = {name: values[:count] if count > 1 else float(values[0]) for name, values in positions.items()}
    names: dict[str, Any] = {"robot": robot, "positions": given, "out": np.empty((len(robot.links), count, 7))}
    yield batch(ours, count, **names) if count > 1 else Statement(ours, names)
    other = pinocchio.Kinematics(path, robot, {name: values[:their_count] for name, values in positions.items()})
    for rows, frame in zip(other.poses(), robot.frames(positions).values(), strict=True):
        mine = np.concatenate((frame.translation, frame.quaternion), axis=-1)[:their_count]
        mine[:, 3:] *= np.sign((mine[:, 3:] * rows[:, 3:]).sum(axis=-1, keepdims=True))  # q and -q are one rotation
        np.testing.assert_allclose(mine, rows, rtol=0, atol=1e-12)
    yield batch(theirs, their_count, other=other)


def many(name: str, ours: str, theirs: str, reference: str, target: Target | None = None) -> Row:
    return Row(
        f"talos, 1e5 configurations, {name}, each", reference, lambda: contenders(ours, theirs, MANY, THEIRS), target
    )


NEW, INTO = "robot.frames(positions)", "robot.frames(positions, out=out)"
KEPT, LEFT = "other.poses()", "other.move()"

ROWS = [
    many("new transforms", NEW, KEPT, "Pinocchio in a loop, poses kept", TimesAsFast(20)),
    many("into an array", INTO, KEPT, "Pinocchio in a loop, poses kept", TimesAsFast(20)),
    many("new transforms", NEW, LEFT, "Pinocchio in a loop, poses dropped"),
    many("into an array", INTO, LEFT, "Pinocchio in a loop, poses dropped"),
    Row(
        "talos, one configuration",
        "Pinocchio, poses kept",
        lambda: contenders(NEW, KEPT, 1, 1),
        TimesAsFast(5),
    ),
]
