# SPDX-License-Identifier: Apache-2.0
"""Explanations: the verdict matches the lookup, and the edges that are named are the ones at fault."""

import operator
import random
import time
from functools import reduce
from itertools import pairwise

import pytest

import coframe
from coframe.errors import TransformException

SECOND = 1_000_000_000
MS = 1_000_000
NOW = coframe.Transform()


def moving(buffer, parent, child, first, last, step, authority="/wheels"):
    for stamp in range(first, last + 1, step):
        buffer.set(parent, child, NOW, stamp, authority=authority)


@pytest.fixture
def buffer():
    """odom -> base from 10 s to 12 s at 50 Hz, base -> arm from 10 s to 11.9 s at 10 Hz, base -> lidar static."""
    buffer = coframe.Buffer()
    moving(buffer, "odom", "base", 10 * SECOND, 12 * SECOND, 20 * MS)
    moving(buffer, "base", "arm", 10 * SECOND, 11_900 * MS, 100 * MS, "/arm")
    buffer.set("base", "lidar", NOW, static=True, authority="/mounts")
    return buffer


def test_explanation_describes_each_edge_of_the_chain(buffer):
    why = buffer.why("lidar", "arm")
    assert why.possible
    assert why.frames == ("lidar", "base", "arm")
    mount, arm = why.edges
    assert (mount.name, mount.static, mount.publisher, mount.age) == ("base -> lidar", True, "/mounts", None)
    assert (arm.name, arm.static, arm.publisher) == ("base -> arm", False, "/arm")
    assert (arm.oldest, arm.newest, arm.rate) == (10 * SECOND, 11_900 * MS, pytest.approx(10.0))
    assert why.answered == 11_900 * MS
    assert why.limit == ("base", "arm")
    assert why.span == (10 * SECOND, 11_900 * MS)
    assert (why.code, why.hint, why.text) == ("", "", "")
    assert str(why).splitlines() == [
        "yes: there is a transform from arm to lidar, the latest at 11.900000000, limited by base -> arm",
        "  frame              oldest        newest        age  rate   publisher",
        "  base",
        "  ├─ lidar (target)  static                                  /mounts",
        "  └─ arm (source)    10.000000000  11.900000000       10 Hz  /arm",
    ]


def test_late_edge_reports_the_delay_and_when_the_next_sample_is_due(buffer):
    why = buffer.why("odom", "arm", 11_987_654_321)
    assert not why.possible
    assert why.code == "too_new"
    (late,) = why.broken
    assert (late.name, late.state, late.by, late.due) == ("base -> arm", "too_new", 87_654_321, 12_345_679)
    assert "base -> arm is 87.7 ms behind the requested time; the next transform is due 12.3 ms after that time" in str(
        why
    )
    assert "lookup_transform('odom', 'arm', stamp, timeout=Duration(seconds=0.5))" in why.hint
    assert why.text == buffer._why_not("odom", "arm", 11_987_654_321)


def test_all_late_edges_are_named(buffer):
    why = buffer.why("odom", "arm", 12_050 * MS)
    assert [(edge.name, edge.by) for edge in why.broken] == [("odom -> base", 50 * MS), ("base -> arm", 150 * MS)]


def test_request_before_the_oldest_sample_reports_the_difference(buffer):
    why = buffer.why("odom", "arm", 9_999_999_999)
    assert [(edge.name, edge.state, edge.by) for edge in why.broken] == [
        ("odom -> base", "too_old", -1),
        ("base -> arm", "too_old", -1),
    ]
    assert "1 ns after the requested time; the buffer keeps 10 s; 1 more edge has no data" in str(why)
    assert "at 10.000000000" in why.hint
    moving(buffer, "odom", "base", 13 * SECOND, 25 * SECOND, 20 * MS)
    assert "coframe.Buffer(cache=" in buffer.why("odom", "lidar", 11 * SECOND).hint, (
        "the requested time is beyond the cache length"
    )


def test_single_sample_is_available_only_at_its_own_time():
    buffer = coframe.Buffer()
    buffer.set("a", "b", NOW, 5 * SECOND)
    for stamp, by in ((7 * SECOND, 2 * SECOND), (4 * SECOND, -SECOND)):
        (edge,) = buffer.why("a", "b", stamp).broken
        assert (edge.state, edge.by) == ("only_other", by)
    assert "a -> b is available only at one time, 2 s before the requested time" in str(
        buffer.why("a", "b", 7 * SECOND)
    )


def test_two_trees_name_their_roots_and_the_likely_missing_edge():
    buffer = coframe.Buffer()
    buffer.set("odom", "base_link", NOW, static=True)
    buffer.set("base_lnk", "camera", NOW, static=True)
    why = buffer.why("odom", "camera")
    assert why.roots == ("odom", "base_lnk")
    assert why.missing[:2] == ("base_link", "base_lnk")
    assert "'base_lnk' looks like a misspelling of 'base_link'" in str(why)
    assert "t.header.frame_id = 'base_link'" in why.hint
    assert [edge.name for edge in why.edges] == ["base_lnk -> camera"]
    buffer.set("shelf", "box", NOW, static=True)
    assert "; a transform such as odom -> shelf is missing" in str(buffer.why("odom", "box"))


@pytest.mark.parametrize(
    ("asked", "word"),
    [("camera_lnk", "'camera_link'"), ("robot1/camera_link", "'camera_link'"), ("/camera_link", "'camera_link'")],
)
def test_misspelled_frame_name_suggests_the_right_one(asked, word):
    buffer = coframe.Buffer()
    buffer.set("base_link", "camera_link", NOW, static=True)
    why = buffer.why("base_link", asked)
    assert why.unknown == (asked,)
    assert (why.edges, why.roots, why.missing) == ((), None, None)
    assert word in why.hint
    if asked == "camera_lnk":
        assert "lookup_transform('base_link', 'camera_link', ...)" in why.hint


def test_missing_prefix_suggests_the_prefixed_frames():
    buffer = coframe.Buffer()
    for robot in ("robot1", "robot2"):
        buffer.set("map", f"{robot}/base_link", NOW, static=True)
    assert "Did you mean 'robot1/base_link' or 'robot2/base_link'?" in buffer.why("map", "base_link").hint


def test_edges_without_a_common_time():
    buffer = coframe.Buffer(cache=None)
    moving(buffer, "map", "odom", 10 * SECOND, 12 * SECOND, 500 * MS)
    moving(buffer, "odom", "base", 14 * SECOND, 16 * SECOND, 500 * MS)
    why = buffer.why("map", "base")
    assert (why.span, why.limit) == (None, ("map", "odom"))
    assert [(edge.name, edge.by) for edge in why.broken] == [("odom -> base", -2 * SECOND)]
    assert why.hint.startswith("The samples of map -> odom end before those of odom -> base begin")


def test_hint_for_a_recording_names_its_time_span():
    buffer = coframe.Buffer(cache=None)
    moving(buffer, "odom", "base", 10 * SECOND, 12 * SECOND, 20 * MS)
    hint = buffer.why("odom", "base", 13 * SECOND).hint
    assert hint.startswith("Request a time from 10.000000000 to 12.000000000")


def test_gap_and_changed_parent_are_remarked():
    buffer = coframe.Buffer(cache=None)
    moving(buffer, "odom", "base", 10 * SECOND, 20 * SECOND, 20 * MS)
    moving(buffer, "odom", "base", 23 * SECOND, 33 * SECOND, 20 * MS)
    moving(buffer, "table", "cup", 10 * SECOND, 20 * SECOND, SECOND)
    moving(buffer, "base", "cup", 21 * SECOND, 30 * SECOND, SECOND)
    (edge,) = buffer.why("odom", "base", 21 * SECOND).edges
    assert (edge.state, edge.gap) == ("ok", 3 * SECOND)
    assert "in a gap of 3 s" in str(buffer.why("odom", "base", 21 * SECOND))
    then = buffer.why("table", "cup", 15 * SECOND)
    assert (then.possible, then.edges[0].name, then.edges[0].later) == (True, "table -> cup", "base")
    assert "the parent is now base" in str(then)
    now = buffer.why("table", "cup")
    assert (now.possible, now.possible_at) == (False, 10 * SECOND)
    assert "there is a transform at 10.000000000" in str(now)


def test_hint_for_a_stale_edge_does_not_suggest_a_timeout():
    now = time.time_ns()
    buffer = coframe.Buffer()
    moving(buffer, "odom", "base", now - 6 * SECOND, now - 4 * SECOND, 20 * MS)
    assert "stale: no transform for 4 s" in str(buffer.why("odom", "base", now=now))
    hint = buffer.why("odom", "base", now, now=now).hint
    assert hint.startswith(
        "The newest sample of odom -> base is 4 s old. Has its publisher, /wheels, stopped, or are its stamps behind"
    )
    assert "lookup_transform('odom', 'base', rclpy.time.Time())" in hint
    fresh = buffer.why("odom", "base", now - 3_990 * MS, now=now - 3_980 * MS).hint
    assert "timeout=Duration(seconds=0.1)" in fresh
    assert (
        "does its publisher use another clock?"
        in buffer.why("odom", "base", now + 100 * SECOND, now=now - 4 * SECOND).hint
    )


def test_cleared_buffer_loop_and_unusual_requests(buffer):
    buffer.clear()
    for stamp in (0, 11 * SECOND):
        why = buffer.why("odom", "arm", stamp)
        assert [edge.state for edge in why.broken] == ["no_data"]
        assert why.hint.startswith("The buffer was cleared and has received no transform to arm")
        assert "? -> arm is no longer available" in str(why)
    loop = coframe.Buffer()
    for parent, child in (("a", "b"), ("b", "c"), ("c", "a"), ("a", "d")):
        loop.set(parent, child, NOW, static=True)
    assert loop.why("d", "nobody").code == "unknown_frame"
    for target in "abcd":
        for source in "abcd":
            why = loop.why(target, source)
            assert why.possible == loop.can_transform(target, source)
            assert str(why)
    assert buffer.why("x", "x").possible, "as in tf2, any name can be looked up in itself"
    assert buffer.why("", "x").hint.startswith("Give the name of a frame")
    with pytest.raises(TypeError, match="float"):
        buffer.why("odom", "arm", 1.5)


def forest(chance, reparents=False, published=0.8):
    """Return a buffer that keeps everything, with a random forest whose edges have samples at random times."""
    buffer = coframe.Buffer(cache=None)
    frames = [f"f{number}" for number in range(chance.randint(2, 9))]
    for number, child in enumerate(frames[1:], 1):
        if chance.random() < published:
            static = chance.random() < 0.3
            first = chance.randint(1, 60)
            count = 1 if static else chance.choice((1, 2, 5, 20))
            parent = frames[chance.randrange(number)]
            for k in range(count):
                parent = frames[chance.randrange(number)] if reparents else parent
                place = coframe.Transform([chance.random(), k, number])
                buffer.set(parent, child, place, (first + k) * SECOND, static=static)
    return buffer, [frame for frame in frames if frame in buffer]


def question(chance, frames):
    return *chance.choices(frames, k=2), chance.choice((0, chance.randint(1, 100) * SECOND // 2))


@pytest.mark.parametrize("reparents", [False, True])
def test_verdict_matches_the_lookup(reparents):
    chance = random.Random(reparents)
    verdicts = []
    for _ in range(50):
        buffer, frames = forest(chance, reparents)
        for asked in [question(chance, frames) for _ in range(5)] if frames else ():
            why = buffer.why(*asked)
            verdicts.append(buffer.can_transform(*asked))
            assert why.possible == verdicts[-1]
            assert why.possible == (not why.broken and why.roots is None), "a failed lookup always names a cause"
            if not why.possible:
                with pytest.raises(TransformException) as caught:
                    buffer.lookup(*asked)
                assert (why.code, why.text) == (caught.value.code, str(caught.value))
            else:
                assert buffer.lookup(*asked).stamp == why.answered
                steps = [buffer.lookup(*pair, why.answered) for pair in pairwise(why.frames)]
                end = reduce(operator.matmul, steps, NOW).translation
                assert end == pytest.approx(buffer.lookup(*asked).translation), (
                    "the edges are those that the lookup uses"
                )
            assert str(why).startswith("yes" if why.possible else "no")
    assert 0.2 < sum(verdicts) / len(verdicts) < 0.8


def test_named_edges_are_exactly_those_that_are_missing():
    """With all named edges the lookup succeeds, and without any one of them it fails."""
    chance = random.Random(3)
    repaired = joined = 0
    for _ in range(150):
        buffer, frames = forest(chance, published=0.6)
        if not frames:
            continue
        target, source, stamp = question(chance, frames)
        why = buffer.why(target, source, stamp)
        when = stamp or (buffer.latest_common_time(target, source) if why.broken and why.roots is None else 0)
        wanted = [(edge.parent, edge.child, when) for edge in why.broken]
        if why.missing is not None:
            wanted.append((why.missing.parent, why.missing.child, None))
        for parent, child, at in wanted:
            assert not buffer.can_transform(target, source, stamp)
            buffer.set(parent, child, NOW, at, static=at is None)
        joined += why.missing is not None
        if why.roots is not None and stamp == 0:  # the trees are connected now, but may have no common time
            assert buffer.why(target, source).roots is None
            continue
        assert buffer.can_transform(target, source, stamp), (why, wanted)
        repaired += bool(why.broken)
    assert min(repaired, joined) > 20
