# SPDX-License-Identifier: Apache-2.0
"""The poses of frames in a tab equal those of the buffer, at any time, in any fixed frame and at any distance."""

import numpy as np
import pytest

import coframe

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND


def turning_tree(frames=30, offset=(0.0, 0.0, 0.0), seed=1):
    """Return a random tree below `map` that moves for ten seconds; its first frame is `offset` away."""
    generator = np.random.default_rng(seed)
    buffer = coframe.Buffer(None)
    stamps = BEGIN + np.arange(0, 11) * SECOND
    for i in range(frames):
        poses = generator.normal(size=(len(stamps), 7))
        if i == 0:
            poses[:, :3] += offset
        poses[:, 3:] /= np.linalg.norm(poses[:, 3:], axis=1, keepdims=True)
        parent = "map" if i == 0 else f"f{generator.integers(0, i)}"
        if i % 5 == 4:
            buffer.set_many(parent, f"f{i}", None if i < 0 else stamps[:1], poses[:1], static=True)
        else:
            buffer.set_many(parent, f"f{i}", stamps, poses)
    return buffer


def assert_equals_buffer(buffer, tab, update, fixed, stamp, tolerance=1e-5):
    for frame in buffer.frame_names():
        expected = buffer.lookup(fixed, frame, stamp)
        shown = tab.world(update, frame)
        np.testing.assert_allclose(shown[:3], expected.translation, atol=tolerance, err_msg=frame)
        assert abs(abs(shown[3:] @ expected.quaternion) - 1.0) < 1e-5, frame


def test_live_poses_are_the_latest_of_the_buffer(view, open_tab):
    buffer = turning_tree()
    tab = open_tab(view(buffer, fixed="map"))
    update = tab.frame_update()
    assert tab.received[:3] == ["hello", "tree", "stats"]
    hello, tree = tab.last["hello"], tab.last["tree"]
    assert (hello["mode"], hello["fixed"], tree["fixed"]) == ("buffer", "map", "map")
    assert [frame["name"] for frame in tree["frames"]] == buffer.frame_names()
    names = [frame["name"] for frame in tree["frames"]]
    parents = {frame["name"]: names[frame["parent"]] if frame["parent"] >= 0 else "" for frame in tree["frames"]}
    assert parents == {info.name: info.parent for info in buffer.frames()}
    assert tree["components"] == [{"root": "map", "size": 31}]
    assert int(hello["origin"]) + update.time == BEGIN + 10 * SECOND
    assert (update.states == 0).all()
    assert_equals_buffer(buffer, tab, update, "map", 0)


def test_time_travel_equals_the_lookups_of_the_buffer(view, open_tab):
    buffer = turning_tree()
    tab = open_tab(view(buffer, fixed="map"))
    tab.frame_update()
    origin = int(tab.last["hello"]["origin"])
    for stamp in (BEGIN, BEGIN + 3_210_000_000, BEGIN + 9_999_000_000):
        tab.send("time", mode="at", at=stamp - origin, playing=False)
        update = tab.frame_update(lambda update, stamp=stamp: update.time == stamp - origin)
        assert_equals_buffer(buffer, tab, update, "map", stamp)
    tab.send("fixed", frame="f7")
    update = tab.frame_update(lambda _update: tab.last["tree"]["fixed"] == "f7")
    assert_equals_buffer(buffer, tab, update, "f7", BEGIN + 9_999_000_000)
    tab.send("time", mode="live")
    assert_equals_buffer(
        buffer, tab, tab.frame_update(lambda update: update.time == BEGIN + 10 * SECOND - origin), "f7", 0
    )


@pytest.mark.parametrize("offset", [(500_000.0, 5_800_000.0, 120.0), (-3e6, 0.0, 0.0)])
def test_poses_in_utm_coordinates_stay_exact(view, open_tab, offset):
    buffer = turning_tree(12, offset)
    tab = open_tab(view(buffer, fixed="map"))
    update = tab.frame_update()
    assert np.abs(update.origin).max() > 1e5
    assert_equals_buffer(buffer, tab, update, "map", 0)
    tab.send("fixed", frame="f3")
    update = tab.frame_update(lambda _update: tab.last["tree"]["fixed"] == "f3")
    assert_equals_buffer(buffer, tab, update, "f3", 0, tolerance=0.5)  # The map itself is far away.
    near = [frame for frame in buffer.frame_names() if frame != "map"]
    for frame in near:
        np.testing.assert_allclose(tab.world(update, frame)[:3], buffer.lookup("f3", frame).translation, atol=1e-5)


def test_frames_of_other_trees_are_expressed_in_their_own_root(view, open_tab):
    buffer = coframe.Buffer(None)
    buffer.set("map", "base", coframe.Transform([1.0, 0.0, 0.0]), BEGIN)
    buffer.set("map", "other", coframe.Transform([1.0, 1.0, 0.0]), BEGIN)
    buffer.set("dock", "charger", coframe.Transform([0.0, 2.0, 0.0]), BEGIN)
    tab = open_tab(view(buffer))
    update = tab.frame_update()
    assert tab.last["tree"]["fixed"] == "map", "the root of the larger tree"
    assert {one["root"]: one["size"] for one in tab.last["tree"]["components"]} == {"map": 3, "dock": 2}
    assert [tab.state(update, name) for name in ("map", "base", "dock", "charger")] == [0, 0, 3, 3]
    np.testing.assert_allclose(tab.world(update, "charger")[:3] - update.origin, [0.0, 2.0, 0.0])
    tab.send("fixed", frame="missing")
    update = tab.frame_update(lambda _update: tab.last["tree"]["fixed"] == "missing")
    assert (update.states == 3).all()
    tab.send("fixed", frame="")
    tab.frame_update(lambda _update: tab.last["tree"]["fixed"] == "map")


def test_the_last_pose_is_held_for_the_frame_timeout(view, open_tab):
    buffer = coframe.Buffer(None)
    for second in range(31):
        buffer.set("map", "base", coframe.Transform([second, 0.0, 0.0]), BEGIN + second * SECOND)
    for second in range(11):
        buffer.set("base", "arm", coframe.Transform([0.0, second, 0.0]), BEGIN + second * SECOND)
    tab = open_tab(view(buffer, fixed="map"))
    tab.frame_update()
    origin = int(tab.last["hello"]["origin"])
    shown = {}
    for second in (5, 12, 28):
        tab.send("time", mode="at", at=BEGIN + second * SECOND - origin)
        update = tab.frame_update(lambda update, second=second: update.time == BEGIN + second * SECOND - origin)
        shown[second] = (tab.state(update, "base"), tab.state(update, "arm"), tab.world(update, "arm")[:2].tolist())
    assert shown[5] == (0, 0, [5.0, 5.0])
    assert shown[12] == (0, 1, [12.0, 10.0]), "held for two seconds after its last sample"
    assert shown[28][:2] == (0, 2)
    assert np.isnan(shown[28][2]).all()
    tab.send("frame_timeout", seconds=60)
    tab.send("time", mode="at", at=BEGIN + 28 * SECOND + 1 - origin)
    update = tab.frame_update(lambda update: update.time == BEGIN + 28 * SECOND + 1 - origin)
    assert tab.state(update, "arm") == 1


def test_playback_loops_and_steps(view, open_tab):
    buffer = coframe.Buffer(None)
    for tenth in range(101):
        buffer.set("map", "base", coframe.Transform([tenth, 0.0, 0.0]), BEGIN + tenth * SECOND // 10)
    tab = open_tab(view(buffer, fixed="map"))
    tab.frame_update()
    origin = int(tab.last["hello"]["origin"])
    begin = BEGIN - origin
    assert tab.last["hello"]["span"] == [begin, begin + 10 * SECOND]

    tab.send("time", mode="at", at=begin + SECOND, playing=True, speed=4.0, loop=[begin + SECOND, begin + 2 * SECOND])
    tab.frame_update(lambda update: update.time == begin + SECOND or update.time < begin + 2 * SECOND)
    times = [tab.frame_update().time for _ in range(25)]
    assert all(begin + SECOND <= time <= begin + 2 * SECOND for time in times)
    assert (np.diff(times) < 0).any(), "playback started again"
    assert np.median(np.diff(times)) > 0

    tab.send("time", mode="at", at=begin + 9 * SECOND, playing=True, speed=20.0, loop=None)
    end = tab.frame_update(lambda update: update.time == begin + 10 * SECOND)
    assert tab.world(end, "base")[0] == 100.0, "playback stops at the end of the data"

    tab.send("time", mode="at", at=begin + 5 * SECOND + 1, playing=False)
    for direction, expected in ((1, 5_100_000_000), (1, 5_200_000_000), (-1, 5_100_000_000)):
        tab.send("step", direction=direction)
        tab.frame_update(lambda update, expected=expected: update.time == begin + expected)


def test_the_statistics_of_each_frame(view, open_tab):
    buffer = coframe.Buffer(None)
    for tenth in (0, 1, 2, 3, 10):
        buffer.set("map", "base", coframe.Transform(), BEGIN + tenth * SECOND // 10, authority="/driver")
    buffer.set("base", "lidar", coframe.Transform(), static=True)
    tab = open_tab(view(buffer))
    stats = tab.wait("stats")
    rows = dict(zip([frame["name"] for frame in tab.last["tree"]["frames"]], stats["frames"], strict=True))
    assert rows["base"]["publisher"] == "/driver"
    assert rows["base"]["rate"] == pytest.approx(4.0)
    assert rows["base"]["longest_gap"] == pytest.approx(0.7)
    assert rows["base"]["samples"] == 5
    assert rows["base"]["last"] == BEGIN + SECOND - int(tab.last["hello"]["origin"])
    assert rows["base"]["state"] == "fresh"
    assert [rows[name]["state"] for name in ("map", "lidar")] == ["static", "static"]
    assert rows["lidar"]["rate"] is None


@pytest.mark.parametrize(
    "name", ["<img src=x onerror=alert(1)>", "</script>", "x" * 10_000, "two words", "ä\n\u2028\x00"]
)
def test_any_frame_name_is_treated_as_data(view, open_tab, name):
    buffer = coframe.Buffer(None)
    buffer.set("map", name, coframe.Transform([1.0, 2.0, 3.0]), BEGIN)
    tab = open_tab(view(buffer))
    update = tab.frame_update()
    np.testing.assert_allclose(tab.world(update, name)[:3], [1.0, 2.0, 3.0])
    tab.send("fixed", frame=name)
    tab.frame_update(lambda _update: tab.last["tree"]["fixed"] == name)


def test_frames_are_added_and_removed(view, open_tab):
    buffer = coframe.Buffer(None)
    tab = open_tab(view(buffer))
    update = tab.frame_update()
    assert np.isnan(update.time)
    assert len(update.poses) == 0
    assert tab.last["hello"]["span"] is None
    buffer.set("map", "base", coframe.Transform(), BEGIN)
    update = tab.frame_update(lambda update: len(update.poses) == 2)
    assert update.revision == tab.last["tree"]["revision"]
    # The stamp is years ago: a new origin keeps it exact.
    assert int(tab.last["hello"]["origin"]) + update.time == BEGIN
    assert tab.received.count("hello") == 2
    buffer.set("map", "second", coframe.Transform(), BEGIN)
    tab.frame_update(lambda update: len(update.poses) == 3)
    buffer.remove_frame("second")
    tab.frame_update(lambda update: len(update.poses) == 2)


def test_frames_outside_a_loop_of_parents_are_drawn(view, open_tab):
    buffer = coframe.Buffer(None)
    for parent, child in (("a", "b"), ("b", "c"), ("c", "a"), ("map", "base")):
        buffer.set(parent, child, coframe.Transform(), BEGIN)
    tab = open_tab(view(buffer, fixed="map"))
    update = tab.frame_update()
    assert tab.state(update, "base") == 0
    assert len(tab.last["tree"]["components"]) == 2
