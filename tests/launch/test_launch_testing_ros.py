# SPDX-License-Identifier: Apache-2.0
"""launch_testing_ros: topics that tests wait for, and nodes that spin in a thread."""

import pytest

pytest.importorskip("dds_library", reason="the nodes speak DDS")

import launch_testing_ros
import rclpy
from launch import LaunchContext
from launch_testing_ros import DataRepublisher, MessagePump, WaitForTopics
from rclpy.context import Context
from std_msgs.msg import Int32, String


@pytest.fixture
def node(domain_id):
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    node = rclpy.create_node("tester", context=context)
    yield node
    node.destroy_node()
    rclpy.shutdown(context=context)


def test_topics_are_waited_for(node):
    numbers = node.create_publisher(Int32, "numbers", 10)
    words = node.create_publisher(String, "words", 10)

    def publish():
        numbers.publish(Int32(data=next(values)))
        words.publish(String(data="hello"))

    values = iter(range(1_000_000))
    node.create_timer(0.02, publish)
    pump = MessagePump(node)
    pump.start()
    try:
        triggered = []
        topics = [("numbers", Int32), ("words", String)]
        waiter = WaitForTopics(
            topics, timeout=20.0, messages_received_buffer_length=3, trigger=lambda *a, **k: triggered.append((a, k))
        )
        assert waiter.wait("now", speed=2)
        assert triggered[0][0][0].get_name().startswith("_test_node_")
        assert (triggered[0][0][1:], triggered[0][1]) == (("now",), {"speed": 2})
        assert waiter.topics_received() == {"numbers", "words"}
        assert waiter.topics_not_received() == set()
        assert 1 <= len(waiter.received_messages("numbers")) <= 3
        assert waiter.received_messages("words")[0].data == "hello"
        with pytest.raises(KeyError, match="Topics: numbers, words"):
            waiter.received_messages("other")
        waiter.shutdown()
        with WaitForTopics(topics, timeout=20.0) as entered:
            assert entered.topics_received() == {"numbers", "words"}
    finally:
        pump.stop()


@pytest.mark.usefixtures("domain_id")
def test_a_topic_without_messages_is_named():
    with (
        pytest.raises(RuntimeError, match=r"Did not receive messages on these topics: \['silence'\]"),
        WaitForTopics([("silence", String)], timeout=0.2),
    ):
        pass


def test_messages_are_changed_on_their_way(node, eventually):
    received = []
    node.create_subscription(Int32, "out", lambda message: received.append(message.data), 10)
    publisher = node.create_publisher(Int32, "in", 10)
    republisher = DataRepublisher(
        node, "in", "out", Int32, lambda message: Int32(data=10 * message.data) if message.data % 2 else None
    )
    pump = MessagePump(node)
    pump.start()
    try:
        eventually(lambda: publisher.get_subscription_count() == 1)
        for number in range(4):
            publisher.publish(Int32(data=number))
        eventually(lambda: republisher.get_num_received() == 4 and received == [10, 30])
        assert republisher.get_num_republished() == 2
        assert [message.data for message in republisher.get_republished()] == [10, 30]
        republisher.shutdown()
    finally:
        pump.stop()


def test_processes_are_separated_from_other_nodes(monkeypatch):
    monkeypatch.delenv("ROS_DOMAIN_ID", raising=False)
    context = LaunchContext()
    launch_testing_ros.actions.EnableRmwIsolation().execute(context)
    assert 1 <= int(context.environment["ROS_DOMAIN_ID"]) <= 101
    assert context.environment["ROS_AUTOMATIC_DISCOVERY_RANGE"] == "LOCALHOST"
    monkeypatch.setenv("ROS_DOMAIN_ID", "7")
    launch_testing_ros.actions.EnableRmwIsolation().execute(context)
    assert context.environment["ROS_DOMAIN_ID"] == "7"


def test_lines_of_a_middleware_are_removed(tmp_path, monkeypatch):
    (tmp_path / "rmw_some_cpp").mkdir()
    (tmp_path / "rmw_some_cpp" / "__init__.py").touch()
    (tmp_path / "rmw_some_cpp" / "rmw_output_prefixes.txt").write_text("[RMW]\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    keep = launch_testing_ros.tools.basic_output_filter(
        filtered_patterns=[r"\d+ warnings"], filtered_rmw_implementation="rmw_some_cpp"
    )
    assert keep("[RMW] started\nhello\n3 warnings\nworld\n") == "hello\nworld\n"
