# SPDX-License-Identifier: Apache-2.0
import pytest

import coframe
from coframe import WireError
from coframe.messages import find

TRANSFORM_STAMPED = find("geometry_msgs/msg/TransformStamped")


def stamped(parent, child, x=0.0):
    message = TRANSFORM_STAMPED()
    message.header.frame_id, message.child_frame_id = parent, child
    message.transform.translation.x = x
    message.transform.rotation.w = 1.0
    return message


def late_joiner(participant, node):
    buffer = coframe.Buffer()
    participant.tf_reader(node, "/tf_static", buffer, static=True)
    return buffer


def test_two_broadcasters_of_a_process_share_one_writer(participant, node, eventually):
    other = participant.add_node("/", "other")
    first = participant.static_broadcaster(node)
    second = participant.static_broadcaster(other)
    first.send([stamped("base_link", "lidar")])
    second.send([stamped("base_link", "camera"), stamped("camera", "lens")])
    assert {publisher.node for publisher in participant.publishers("/tf_static")} <= {"tester", "other"}
    buffer = late_joiner(participant, node)
    eventually(lambda: buffer.can_transform("lidar", "lens"))
    assert buffer.statistics["messages"] == 1


def test_a_late_joining_process_receives_all_static_transforms(participant, node, child):
    participant.static_broadcaster(node).send([stamped("base_link", "lidar")])
    participant.static_broadcaster(node).send([stamped("base_link", "camera")])
    other = child("""
        import coframe
        with coframe.connect("late") as ros:
            ros.buffer.lookup("lidar", "camera", timeout="20s")
            print("got it", flush=True)
            input()
    """)
    assert other.read() == "got it"
    assert other.finish() == (0, "")


def test_a_later_transform_for_the_same_child_replaces_the_earlier(participant, node):
    broadcaster = participant.static_broadcaster(node)
    message = stamped("base_link", "lidar", 1.0)
    broadcaster.send([message])
    message.transform.translation.x = 2.0
    broadcaster.send([stamped("base_link", "camera")])
    assert late_joiner(participant, node).lookup("base_link", "lidar", timeout="10s").translation[0] == 1.0
    broadcaster.send([message])
    assert late_joiner(participant, node).lookup("base_link", "lidar", timeout="10s").translation[0] == 2.0


def test_closing_the_last_broadcaster_closes_the_writer(participant, node, eventually):
    other = participant.add_node("/", "other")
    first = participant.static_broadcaster(node)
    second = participant.static_broadcaster(other)
    first.send([stamped("base_link", "lidar")])
    first.close()
    first.close()
    assert [publisher.node for publisher in participant.publishers("/tf_static")] == ["other"]
    buffer = late_joiner(participant, node)
    eventually(lambda: buffer.can_transform("base_link", "lidar"))
    second.close()
    assert participant.publishers("/tf_static") == []


def test_closing_a_node_keeps_the_writer_of_other_nodes(participant, node):
    other = participant.add_node("/", "other")
    first = participant.static_broadcaster(other)
    second = participant.static_broadcaster(node)
    first.send([stamped("base_link", "lidar")])
    other.close()
    second.send([stamped("base_link", "camera")])
    assert late_joiner(participant, node).can_transform("lidar", "camera", timeout="10s")


def test_a_new_writer_starts_without_transforms(participant, node):
    first = participant.static_broadcaster(node)
    first.send([stamped("base_link", "lidar")])
    first.close()
    with pytest.raises(WireError, match=r"static transform broadcaster .* closed"):
        first.send([stamped("base_link", "lidar")])
    second = participant.static_broadcaster(node)
    second.send([stamped("base_link", "camera")])
    assert not late_joiner(participant, node).frame_exists("lidar")


def test_topics_have_separate_writers(participant, node):
    participant.static_broadcaster(node).send([stamped("base_link", "lidar")])
    participant.static_broadcaster(node, "/robot/tf_static").send([stamped("base_link", "camera")])
    assert not late_joiner(participant, node).frame_exists("camera")
