# SPDX-License-Identifier: Apache-2.0
"""Recordings in a tab: frames and messages at any time."""

import numpy as np
import pytest

pytest.importorskip("rosbags", reason="recordings need rosbags")

import coframe


def test_a_recording_at_any_time(shared, view, open_tab):
    path = shared / "recordings" / "tb3_gazebo_walker"
    tab = open_tab(view(path, fixed="odom"))
    hello = tab.wait("hello")
    assert (hello["mode"], hello["title"], hello["can_publish"]) == ("recording", "tb3_gazebo_walker", False)
    scan = {"topic": "/scan", "type": "sensor_msgs/msg/LaserScan", "display": "LaserScan", "automatic": True}
    assert scan in hello["topics"]
    first, last = hello["span"]
    tab.send("subscribe", id=1, topic="/scan", options={})
    bag = coframe.open_bag(path)
    origin = int(hello["origin"])
    stamps = np.sort(bag.stamps("/scan"))
    seen = set()
    for share in (0.8, 0.3):
        at = first + round(share * (last - first))
        tab.send("time", mode="at", at=at)
        expected = int(stamps[stamps <= at + origin][-1]) - origin
        update = tab.frame_update(
            lambda update, at=at, expected=expected: (
                update.time == at and any(tab.drawings[key].stamp == expected for key in update.displays)
            )
        )
        ((key, pose),) = update.displays.items()
        message = bag.message_at("/scan", at + origin).message
        frame, stamp = message.header.frame_id, expected + origin
        np.testing.assert_allclose(
            pose[:3] + update.origin, bag.buffer.lookup("odom", frame, stamp).translation, atol=1e-5
        )
        np.testing.assert_allclose(
            tab.world(update, "base_scan")[:3],
            bag.buffer.lookup("odom", "base_scan", at + origin).translation,
            atol=1e-5,
        )
        seen.add(key)
    assert len(seen) == 2
    assert tab.has("robot")["name"] == "turtlebot3_burger"
    bag.close()


def test_a_topic_without_a_display_gives_a_message(shared, view, open_tab):
    tab = open_tab(view(shared / "recordings" / "tb3_gazebo_walker"))
    tab.send("subscribe", id=1, topic="/robot_description", options={})
    received = tab.wait("display", lambda received: received["state"] == "error")
    assert "the viewer has no display for std_msgs/msg/String" in received["text"]
    tab.frame_update()


def test_a_ros_1_bag_with_slashes_in_front_of_frame_names(shared, view, open_tab):
    tab = open_tab(view(shared / "recordings" / "tilt_laser.bag"))
    hello = tab.wait("hello")
    (topic,) = [topic for topic in hello["topics"] if topic["display"] == "LaserScan"]
    tab.send("subscribe", id=1, topic=topic["topic"], options={})
    first, last = hello["span"]
    tab.send("time", mode="at", at=(first + last) / 2)
    tab.frame_update(lambda update: update.displays)
    assert tab.last["display"]["state"] == "ok"


def test_scans_are_drawn_in_a_tree_with_a_prefix(shared, view, open_tab):
    with coframe.open_bag(shared / "recordings" / "tb3_gazebo_walker", prefix="r1/", keep=["odom"]) as bag:
        tab = open_tab(view(bag, fixed="odom"))
        first, last = tab.wait("hello")["span"]
        tab.send("subscribe", id=1, topic="/scan", options={})
        tab.send("time", mode="at", at=(first + last) / 2)
        update = tab.frame_update(lambda update: update.displays)
        assert np.isfinite(tab.world(update, "r1/base_scan")).all()
        assert tab.last["display"]["state"] == "ok"


def test_a_file_that_is_not_a_recording_gives_a_message(tmp_path):
    (tmp_path / "x.mcap").write_bytes(b"nothing")
    with pytest.raises(coframe.RecordingError):
        coframe.show(tmp_path / "x.mcap", port=0)
