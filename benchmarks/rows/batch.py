# SPDX-License-Identifier: Apache-2.0
"""Many lookups and many insertions in one call."""

import time
from collections.abc import Callable, Generator
from typing import Any

import numpy as np

import coframe
from benchmarks import ours
from benchmarks.measuring import AtMost, Contender, Row, Target, TimesAsFast
from benchmarks.motion import frame
from benchmarks.ours import Stamps
from benchmarks.peers import by_hand, tf_trees
from benchmarks.statement import Statement

LOOKUPS, SAMPLES = 100_000, 10_000
MANY_LOOKUPS, MANY_SAMPLES, FEW_SAMPLES, DEEP = 1_000_000, 100_000, 100, 10
STORED = 100_000


def filled(depth: int, samples: int) -> coframe.Buffer:
    buffer = coframe.Buffer(None)
    for edge in range(depth):
        stamps, values = ours.stamps_and_values(edge, samples)
        buffer.set_many(frame(edge), frame(edge + 1), stamps, values)
    return buffer


def batch(code: str, items: int, clock: Callable[[], int] = time.process_time_ns, **names: Any) -> Statement:
    """Return a statement for long runs, timed by the processor time of all threads."""
    return Statement(code, names, items=items, clock=clock)


def looking_up(depth: int, times: Stamps, samples: int, *, items: int | None = None, code: str = "") -> Statement:
    return batch(
        code or "buffer.lookup_many('f0', source, times, out=out)",
        items or len(times),
        buffer=filled(depth, samples),
        source=frame(depth),
        times=times,
        out=np.empty((len(times), 7)),
    )


def matrices(depth: int, times: Stamps, samples: int) -> Any:
    """Return coframe's results, to check those of a peer."""
    return filled(depth, samples).lookup_many("f0", frame(depth), times).matrix


def versus_tf_tree(order: str, code: str, their_code: str, target: Target | None) -> Row:
    """Return a row for arrays of positions and quaternions at 1e5 times."""

    def contenders() -> Generator[Contender]:
        times = ours.random_times(LOOKUPS, SAMPLES, in_order=order == "sorted")
        yield looking_up(5, times, SAMPLES, code=code)
        plan = tf_trees.plan(5, SAMPLES)
        np.testing.assert_allclose(plan.at(times[:1000]), matrices(5, times[:1000], SAMPLES), atol=1e-9)
        yield batch(their_code, LOOKUPS, plan=plan, times=times, out=np.empty((LOOKUPS, 7)))

    into = "into an array" if "out" in code else "a new array"
    return Row(f"lookup_many, N=1e5, {order}, D=5, {into}", "tf_tree, Plan", contenders, target)


def with_twists() -> Row:
    """Return a row for poses with twists; tf_tree has these only with screw interpolation."""

    def contenders() -> Generator[Contender]:
        times = ours.random_times(LOOKUPS, SAMPLES, in_order=True)
        yield looking_up(5, times, SAMPLES, code="buffer.lookup_many('f0', source, times, out=out, twist=True)")
        plan = tf_trees.plan(5, SAMPLES, interpolation="sclerp")
        names = {"plan": plan, "times": times, "out": np.empty((LOOKUPS, 13))}
        yield batch("plan.at_into(times, out, layout='quat_twist')", LOOKUPS, **names)

    return Row("lookup_many, N=1e5, sorted, D=5, with twists", "tf_tree, Plan, screw interpolation", contenders)


OURS_INTO, OURS_NEW = "buffer.lookup_many('f0', source, times, out=out)", "buffer.lookup_many('f0', source, times)"
THEIRS_INTO, THEIRS_NEW = "plan.at_into(times, out, layout='quat')", "plan.at(times, layout='quat')"


def versus_hand(depth: int, reference: str, make: Callable[[Any], Any], tolerance: float = 1e-9) -> Row:
    """Return a row for a peer implemented by hand.

    pytransform3d uses screw interpolation, so that its poses between two samples differ slightly.
    """

    def contenders() -> Generator[Contender]:
        times = ours.random_times(LOOKUPS, SAMPLES, in_order=True)
        yield looking_up(depth, times, SAMPLES)
        other = make([ours.stamps_and_values(edge, SAMPLES) for edge in range(depth)])
        found = other.at(times[:100])
        expected = matrices(depth, times[:100], SAMPLES)
        np.testing.assert_allclose(
            found[:, :3] if found.ndim == 2 else found[:, :3, 3], expected[:, :3, 3], atol=tolerance
        )
        yield batch("other.at(times)", LOOKUPS, other=other, times=times)

    return Row(f"lookup_many, N=1e5, sorted, D={depth}", reference, contenders)


def large() -> Row:
    """Return a row for a million random times in long histories, compared with the same work on cached samples."""

    def contenders() -> Generator[Contender]:
        edges = MANY_LOOKUPS * DEEP
        yield looking_up(DEEP, ours.random_times(MANY_LOOKUPS, MANY_SAMPLES), MANY_SAMPLES, items=edges)
        yield looking_up(DEEP, ours.random_times(MANY_LOOKUPS, FEW_SAMPLES, in_order=True), FEW_SAMPLES, items=edges)

    return Row("lookup_many, N=1e6, random, D=10, n=1e5, per edge", "floor: sorted, n=100", contenders, AtMost(15))


def by_two_threads() -> Row:
    def contenders() -> Generator[Contender]:
        times = ours.random_times(MANY_LOOKUPS, MANY_SAMPLES)
        for threads in (2, 1):
            code = f"buffer.lookup_many('f0', source, times, out=out, threads={threads})"
            names = {
                "buffer": filled(DEEP, MANY_SAMPLES),
                "source": frame(DEEP),
                "times": times,
                "out": np.empty((MANY_LOOKUPS, 7)),
            }
            yield batch(code, MANY_LOOKUPS * DEEP, time.perf_counter_ns, **names)

    return Row("the same with 2 threads, wall clock, per edge", "1 thread", contenders, processors=2)


def storing(other: Callable[[Stamps, Any], Statement], reference: str, target: Target | None) -> Row:
    def contenders() -> Generator[Contender]:
        stamps, values = ours.stamps_and_values(0, STORED)
        names = {"Buffer": coframe.Buffer, "stamps": stamps, "values": values}
        code = "buffer.set_many('f0', 'f1', stamps, values)"
        yield Statement(code, names, setup="buffer = Buffer(None)", items=STORED, limit=1)
        yield other(stamps, values)

    return Row("set_many, N=1e5, in order, per sample", reference, contenders, target)


def copying(stamps: Stamps, values: Any) -> Statement:
    names = {"stamps": stamps, "values": values}
    return Statement("a = stamps.copy(); b = values.copy()", names, items=STORED, limit=1)


def pushing(stamps: Stamps, values: Any) -> Statement:
    tf_trees.empty(1, 2)  # Raises here if tf_tree is not installed.
    names = {
        "build": lambda: tf_trees.empty(1, STORED),
        "stamps": stamps,
        "values": np.ascontiguousarray(values[:, tf_trees.WXYZ_XYZ_FROM_XYZ_XYZW]),
    }
    setup = "publisher = build().publisher('f1', 'f0')"
    return Statement("publisher.push_many(stamps, values)", names, setup=setup, items=STORED, limit=1)


ROWS = [
    versus_tf_tree("sorted", OURS_INTO, THEIRS_INTO, TimesAsFast(5)),
    versus_tf_tree("random", OURS_INTO, THEIRS_INTO, TimesAsFast(5)),
    versus_tf_tree("sorted", OURS_NEW, THEIRS_NEW, None),
    with_twists(),
    versus_hand(1, "numpy by hand", by_hand.Numpy),
    versus_hand(10, "numpy by hand", by_hand.Numpy),
    versus_hand(1, "scipy, Slerp", by_hand.Scipy),
    versus_hand(10, "scipy, Slerp and RigidTransform", by_hand.Scipy),
    versus_hand(1, "pytransform3d", by_hand.Pytransform3d, 1e-4),
    versus_hand(10, "pytransform3d", by_hand.Pytransform3d, 1e-4),
    large(),
    by_two_threads(),
    storing(copying, "floor: copying the arrays", AtMost(10)),
    storing(pushing, "tf_tree, push_many", None),
]
