# SPDX-License-Identifier: Apache-2.0
"""Single lookups from Python."""

from collections.abc import Generator

import numpy as np

import coframe
from benchmarks import motion, ours
from benchmarks.measuring import Contender, Row, Target, TimesAsFast
from benchmarks.motion import frame
from benchmarks.peers import DEBIAN, ROS2, Tf2, tf_trees
from benchmarks.rows.tf2_rows import drop_in, versus_tf2
from benchmarks.statement import Statement

TIME = motion.between(490)

NEWEST = "buffer.lookup('f0', source)"
AT_A_TIME = "buffer.lookup('f0', source, time)"
TIME_TRAVEL = "buffer._lookup_full('f0', time, source, earlier, 'f0')"
POSSIBLE = "buffer.can_transform('f0', source)"
POSSIBLE_AT_A_TIME = "buffer.can_transform('f0', source, time)"
FAILING = """
try:
    buffer.lookup('f0', source, 1)
except TransformException as error:
    pass
"""
FAILING_WITH_TEXT = FAILING.replace("pass", "str(error)")


def lookup(code: str, depth: int) -> Statement:
    names = {
        "buffer": ours.filled(depth),
        "source": frame(depth),
        "time": TIME,
        "earlier": motion.between(300),
        "TransformException": coframe.TransformException,
    }
    return Statement(code, names)


def newest(depth: int, peer: Tf2, target: Target | None = None) -> Row:
    return versus_tf2(f"lookup, newest, D={depth}", lambda: lookup(NEWEST, depth), peer, "lookup", depth, target=target)


def versus_debian(name: str, code: str, function: str, *arguments: object, target: Target | None = None) -> Row:
    """Return a row for a lookup over a chain of five edges."""
    return versus_tf2(f"{name}, D=5", lambda: lookup(code, 5), DEBIAN, function, 5, *arguments, target=target)


def versus_tf_tree(depth: int, what: str, code: str, target: Target | None = None) -> Row:
    """Return a row for a lookup by name, compared with tf_tree's lookup by name or its compiled plan."""

    def contenders() -> Generator[Contender]:
        yield lookup(AT_A_TIME, depth)
        tree = tf_trees.filled(depth)
        plan = tree.plan("f0", frame(depth))
        expected = ours.filled(depth).lookup("f0", frame(depth), TIME).matrix
        np.testing.assert_allclose(plan.at(TIME), expected, atol=1e-9)
        names = {"tree": tree, "plan": plan, "source": frame(depth), "time": TIME, "out": np.empty((4, 4))}
        yield Statement(code, names)

    return Row(f"lookup at a time, D={depth}", f"tf_tree, {what}", contenders, target)


ROWS = [
    newest(1, DEBIAN, TimesAsFast(35)),
    newest(5, DEBIAN, TimesAsFast(25)),
    newest(10, DEBIAN, TimesAsFast(18)),
    newest(50, DEBIAN, TimesAsFast(10)),
    newest(5, ROS2),
    versus_debian("lookup at a time", AT_A_TIME, "lookup", TIME),
    versus_tf_tree(1, "Plan.at", "plan.at(time)", TimesAsFast(2.5)),
    versus_tf_tree(5, "Plan.at", "plan.at(time)", TimesAsFast(3)),
    versus_tf_tree(5, "Plan.at_into", "plan.at_into(time, out)"),
    versus_tf_tree(5, "Tree.lookup", "tree.lookup('f0', source, time)"),
    versus_debian("time travel", TIME_TRAVEL, "time_travel"),
    versus_debian("can_transform, newest", POSSIBLE, "can_transform", target=TimesAsFast(12)),
    versus_debian("can_transform at a time", POSSIBLE_AT_A_TIME, "can_transform", TIME, target=TimesAsFast(12)),
    versus_debian("failing lookup, caught", FAILING, "failing_lookup", target=TimesAsFast(10)),
    versus_debian("failing lookup, text read", FAILING_WITH_TEXT, "failing_lookup", "str(error)"),
    drop_in("tf2_py: lookup_transform_core, D=5", DEBIAN, "lookup", 5, target=TimesAsFast(8)),
    drop_in("tf2_py: lookup_transform_core, D=5", ROS2, "lookup", 5),
    drop_in("tf2_py: can_transform_core, D=5", DEBIAN, "can_transform", 5),
    drop_in("tf2_py: can_transform_core, D=5", ROS2, "can_transform", 5),
    drop_in("tf2_py: failing lookup, caught, D=5", DEBIAN, "failing_lookup", 5),
    drop_in("tf2_py: failing lookup, caught, D=5", ROS2, "failing_lookup", 5),
]
