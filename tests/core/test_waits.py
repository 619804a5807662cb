# SPDX-License-Identifier: Apache-2.0
"""Every insertion that makes a waiting lookup possible ends the wait."""

import random

import pytest

import coframe
from coframe import _core
from coframe.messages.codec import serialize
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

HERE = coframe.Transform()


def insert(buffer, parent, child, *stamps):
    for stamp in stamps:
        buffer.set(parent, child, HERE, stamp)


def insert_static(buffer, parent, child):
    buffer.set(parent, child, HERE, static=True)


def message(parent, child, stamp):
    stamped = TransformStamped(child_frame_id=child)
    stamped.header.frame_id = parent
    stamped.header.stamp.nanosec = stamp
    return serialize(TFMessage(transforms=[stamped]))


def the_edge_above_lags_as_well(buffer):
    insert(buffer, "map", "odom", 10)
    insert(buffer, "odom", "base", 10)
    yield "odom", "base", 11
    insert(buffer, "odom", "base", 12)


def the_edge_above_lags_as_well_and_is_inserted_first(buffer):
    insert(buffer, "map", "odom", 10)
    insert(buffer, "odom", "base", 10)
    yield "map", "base", 11
    insert(buffer, "map", "odom", 12)
    insert(buffer, "odom", "base", 12)


def the_target_gets_a_parent_below_the_gap(buffer):
    insert(buffer, "hand", "cup", 10)
    yield "table", "cup", 11
    insert_static(buffer, "cup", "table")


def the_source_gets_a_parent_although_the_target_lags(buffer):
    insert(buffer, "map", "robot", 10)
    insert_static(buffer, "camera", "tag")
    yield "robot", "tag", 11
    insert_static(buffer, "robot", "camera")


def the_latest_stamps_of_both_edges_are_too_far_apart(buffer):
    insert(buffer, "map", "odom", 5)
    insert(buffer, "odom", "base", *range(10, 20))
    yield "map", "base", None
    insert(buffer, "map", "odom", 15)


def the_latest_stamp_of_an_edge_is_zero(buffer):
    insert(buffer, "map", "odom", 10, 11)
    insert(buffer, "odom", "base", -5, 0)
    yield "map", "base", None
    insert(buffer, "odom", "base", 10)


def a_transform_that_is_too_old_names_a_frame(buffer):
    insert(buffer, "map", "odom", 100_000_000)
    yield "world", "odom", None
    assert buffer.ingest(message("world", "odom", 1)) == 0
    insert(buffer, "world", "map", 100_000_000)


def a_row_that_is_too_old_names_a_frame(buffer):
    insert(buffer, "map", "odom", 100_000_000)
    yield "world", "odom", None
    assert buffer.set_many("world", "odom", [1], [[0, 0, 0, 0, 0, 0, 1]]) == 0
    insert(buffer, "world", "map", 100_000_000)


def rows_have_a_leading_slash(buffer):
    insert(buffer, "map", "odom", 10)
    yield "map", "odom", 12
    assert buffer.set_many("/map", "/odom", [11, 12, 13], [[0, 0, 0, 0, 0, 0, 1]] * 3) == 3


def the_source_was_in_another_tree_then(buffer):
    insert(buffer, "old", "cup", 5, 6)
    insert(buffer, "new", "cup", 7)
    insert_static(buffer, "new", "table")
    yield "table", "cup", 5
    insert_static(buffer, "new", "old")


def a_late_sample_has_another_parent(buffer):
    insert(buffer, "old", "cup", 5)
    insert(buffer, "new", "cup", 8)
    insert(buffer, "old", "cup", 9)
    insert_static(buffer, "table", "plate")
    yield "table", "cup", 7
    insert(buffer, "table", "cup", 6)


def another_tree_is_inserted_after_a_clear(buffer):
    insert(buffer, "old", "cup", 5)
    insert_static(buffer, "table", "plate")
    yield "table", "cup", None
    buffer.clear()
    insert(buffer, "table", "cup", 6)


def a_clear_ends_a_loop(buffer):
    insert(buffer, "a", "b", 5)
    insert(buffer, "b", "a", 5)
    insert_static(buffer, "a", "c")
    insert_static(buffer, "b", "d")
    yield "c", "d", 5
    buffer.clear()
    insert(buffer, "a", "b", 5)


def the_target_is_above_a_loop(buffer):
    insert_static(buffer, "a", "b")
    insert_static(buffer, "b", "a")
    insert(buffer, "c", "d", 5)
    yield "a", "c", None
    insert(buffer, "b", "c", 7)


@pytest.mark.parametrize(
    "scenario",
    [
        the_edge_above_lags_as_well,
        the_edge_above_lags_as_well_and_is_inserted_first,
        the_target_gets_a_parent_below_the_gap,
        the_source_gets_a_parent_although_the_target_lags,
        the_latest_stamps_of_both_edges_are_too_far_apart,
        the_latest_stamp_of_an_edge_is_zero,
        a_transform_that_is_too_old_names_a_frame,
        a_row_that_is_too_old_names_a_frame,
        rows_have_a_leading_slash,
        the_source_was_in_another_tree_then,
        a_late_sample_has_another_parent,
        another_tree_is_inserted_after_a_clear,
        a_clear_ends_a_loop,
        the_target_is_above_a_loop,
    ],
)
def test_a_wait_ends_when(scenario):
    buffer = coframe.Buffer(cache=50_000_000)
    steps = scenario(buffer)
    lookup = next(steps)
    assert not buffer.can_transform(*lookup)
    wait = _core.wait(buffer, _core.Mailbox(), 1, *lookup)
    next(steps, None)
    assert buffer.can_transform(*lookup), "the test is wrong"
    assert wait.transform() is not None


def change(buffer, rng, names, ordered):
    """Return a random change of a buffer; `ordered` keeps most of the tree without loops."""
    i = rng.randrange(1, len(names))
    child, parent = names[i], rng.choice(names[:i] if ordered and rng.random() < 0.9 else names)
    stamp, static, dice = rng.randrange(40), rng.random() < 0.08, rng.random()
    if dice < 0.15:
        buffer.ingest(message(parent, child, stamp), static=static)
    elif dice < 0.17:
        buffer.remove_frame(child)
    elif dice < 0.2:
        buffer.clear()
    else:
        buffer._set_values(parent, child, stamp, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, static, "test")


def random_lookup(rng, names):
    """Return a lookup at one time or between two; 0 is the latest."""
    target, source, fixed = (rng.choice(names) for _ in range(3))
    then, now = (rng.choice([0, rng.randrange(40)]) for _ in range(2))
    return (target, source, then) if rng.random() < 0.8 else (target, now, source, then, fixed)


@pytest.mark.parametrize("seed", range(40))
def test_no_wait_is_missed(seed):
    rng = random.Random(seed)
    buffer = coframe.Buffer(cache=rng.choice(["3ns", "10ns", "30ns", None]))
    names = [f"frame{i}" for i in range(rng.choice([3, 5, 8, 12]))]
    ordered = rng.random() < 0.5
    mailbox = _core.Mailbox()
    waits = {}
    for step in range(300):
        for number in range(2):
            asked = random_lookup(rng, names)
            start = _core.wait if len(asked) == 3 else _core.wait_full
            waits[step, number] = asked, start(buffer, mailbox, 1, *asked)
        change(buffer, rng, names, ordered)
        waits = {key: one for key, one in list(waits.items())[-60:] if one[1].transform() is None}
        for asked, _ in waits.values():
            can = buffer.can_transform if len(asked) == 3 else buffer._can_transform_full
            assert not can(*asked), f"no waiter was woken for {asked}"
