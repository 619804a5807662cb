# SPDX-License-Identifier: Apache-2.0
"""What entities of nodes have since Jazzy and Kilted: `with` blocks, logger names, information on calls, filters."""

import signal
import threading
import time

import pytest

import rclpy
from example_interfaces.action import Fibonacci
from geometry_msgs.msg import PointStamped, Pose, PoseArray
from rclpy._content_filter import ContentFilter
from rclpy.action import ActionClient, ActionServer
from rclpy.clock import ClockType
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.exceptions import InvalidHandle, RCLError
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.qos import QoSPresetProfiles, QoSProfile, qos_profile_rosout_default
from rclpy.signals import SignalHandlerGuardCondition
from rclpy.subscription_content_filter_options import ContentFilterOptions
from rclpy.task import Future
from rclpy.timer import TimerInfo
from std_msgs.msg import String
from std_srvs.srv import Trigger


@pytest.fixture
def executor(context, node):
    with SingleThreadedExecutor(context=context) as executor:
        executor.add_node(node)
        yield executor


def test_a_with_block_destroys_an_entity(node):
    with node.create_publisher(String, "chatter", 1) as publisher:
        publisher.publish(String())
    with pytest.raises(InvalidHandle):
        publisher.publish(String())
    with node.create_client(Trigger, "reset") as client, node.create_timer(1.0, print) as timer:
        assert not client.service_is_ready()
    with pytest.raises(InvalidHandle):
        client.service_is_ready()
    with pytest.raises(InvalidHandle):
        timer.is_ready()
    with node.create_subscription(String, "chatter", print, 1) as subscription:
        assert subscription.get_publisher_count() in (0, 1)
    assert subscription.get_publisher_count() == 0
    with node.create_service(Trigger, "reset", print), node.create_guard_condition(print):
        pass
    with ActionServer(node, Fibonacci, "fibonacci", print), ActionClient(node, Fibonacci, "fibonacci") as action_client:
        pass
    with pytest.raises(InvalidHandle):
        action_client.server_is_ready()


def test_an_error_in_a_with_block_is_passed_on(node):
    with pytest.raises(KeyError), node.create_publisher(String, "chatter", 1) as publisher:
        raise KeyError
    with pytest.raises(InvalidHandle):
        publisher.publish(String())


def test_entities_have_the_logger_name_of_their_node(make_node):
    node = make_node("arm", namespace="/robot")
    entities = [
        node.create_publisher(String, "chatter", 1),
        node.create_subscription(String, "chatter", print, 1),
        node.create_client(Trigger, "reset"),
        node.create_service(Trigger, "reset", print),
    ]
    assert {entity.logger_name for entity in entities} == {"robot.arm"} == {node.get_logger().name}


def test_a_timer_passes_on_the_times_of_its_call(node, executor, wait_until):
    infos = []

    def with_info(info: TimerInfo) -> None:
        infos.append(info)

    def with_text(other: "TimerInfo") -> None:
        infos.append(other)

    timer = node.create_timer(0.01, with_info)
    before = node.get_clock().now()
    wait_until(lambda: infos, lambda: executor.spin_once(timeout_sec=1))
    assert before <= infos[0].expected_call_time <= infos[0].actual_call_time <= node.get_clock().now()
    timer.callback = with_text
    wait_until(lambda: len(infos) > 1, lambda: executor.spin_once(timeout_sec=1))
    assert infos[1].expected_call_time > infos[0].expected_call_time


def test_times_of_timers_are_checked():
    info = TimerInfo(expected_call_time=1, actual_call_time=2, clock_type=ClockType.STEADY_TIME)
    assert (info.expected_call_time.nanoseconds, info.actual_call_time.clock_type) == (1, ClockType.STEADY_TIME)
    with pytest.raises(ValueError, match="must not be negative"):
        TimerInfo(expected_call_time=-1)
    with pytest.raises(TypeError, match="must be a ClockType"):
        TimerInfo(clock_type=1)


FILTERS = [
    ("point.x > 1", [], [2.0, 3.0]),
    ("point.x >= %0 AND point.x < %1", ["1", "3"], [1.0, 2.0]),
    ("NOT (point.x = 1 or point.x = 2.0)", [], [0.0, 3.0]),
    ("header.frame_id = 'map'", [], [2.0]),
    ("header.frame_id <> %0", ["'map'"], [0.0, 1.0, 3.0]),
    ("header.frame_id LIKE 'm%' OR header.frame_id like '_dom'", [], [0.0, 1.0, 2.0, 3.0]),
    ("point.x BETWEEN 0.5 AND 2 and point.y NOT BETWEEN 1 AND 2", [], [1.0, 2.0]),
    ("header.stamp.sec != 0", [], []),
    ("header.frame_id > 1", [], []),
]


@pytest.mark.parametrize(("expression", "parameters", "expected"), FILTERS)
def test_content_filters_select_messages(node, executor, wait_until, expression, parameters, expected):
    received = []
    publisher = node.create_publisher(PointStamped, "points", 10)
    options = ContentFilterOptions(expression, parameters)
    subscription = node.create_subscription(
        PointStamped, "points", lambda m: received.append(m.point.x), 10, content_filter_options=options
    )
    assert subscription.is_cft_enabled
    assert subscription.get_content_filter() == options
    assert publisher.wait_for_all_acked()
    wait_until(lambda: publisher.get_subscription_count() == 1)
    frames = ["odom", "odom", "map", "odom"]
    for x, frame in enumerate(frames):
        message = PointStamped()
        message.header.frame_id, message.point.x = frame, float(x)
        publisher.publish(message)
    subscription_without = []
    node.create_subscription(PointStamped, "points", subscription_without.append, 10)
    for _ in frames:
        executor.spin_once(timeout_sec=5)
    assert received == expected


def test_content_filters_read_elements_of_arrays_and_change(node):
    subscription = node.create_subscription(PoseArray, "poses", print, 1)
    assert not subscription.is_cft_enabled
    with pytest.raises(RCLError, match="the subscription has none"):
        subscription.get_content_filter()
    subscription.set_content_filter("poses[1].position.x = %0", ["5"])

    accepts = ContentFilter(PoseArray, "poses[1].position.x = %0", ["5"]).accepts
    poses = PoseArray(poses=[Pose(), Pose()])
    poses.poses[1].position.x = 5.0
    assert accepts(poses)
    assert not accepts(PoseArray())
    subscription.set_content_filter("", [])
    assert not subscription.is_cft_enabled


@pytest.mark.parametrize(
    ("expression", "problem"),
    [
        ("data", "has '' in place of a comparison"),
        ("text = 'a'", "refers to 'text', which is not a field of std_msgs/msg/String"),
        ("data.x = 1", "refers to 'data.x', which is not a field"),
        ("data[0] = 'a'", "which is not an element of an array"),
        ("data = %3", "has %3, but there are 0 parameters"),
        ("(data = 'a'", "has no ')'"),
        ("data = 'a' data", "has 'data' after its end"),
        ("data = ", "ends where a value is expected"),
        ("data = 'a' AND ;", "has an unexpected character at ';'"),
        ("data BETWEEN 1 OR 2", "has no AND after BETWEEN"),
        ("(" * 100 + "data = 1", "has more than 50 nested conditions"),
        ("data = 1" + " " * 10_000, "has more than 10000 characters"),
    ],
)
def test_invalid_content_filters_say_what_is_wrong(node, expression, problem):
    with pytest.raises(RCLError, match="content filter") as caught:
        node.create_subscription(
            String, "chatter", print, 1, content_filter_options=ContentFilterOptions(expression, [])
        )
    assert problem in str(caught.value)


def test_done_callbacks_are_removed():
    future, calls = Future(), []
    future.add_done_callback(calls.append)
    assert future.remove_done_callback(calls.append)
    assert not future.remove_done_callback(calls.append)
    future.set_result(1)
    assert calls == []


def test_executors_create_futures(executor):
    future, calls = executor.create_future(), []
    future.add_done_callback(calls.append)
    future.set_result(1)
    assert calls == []
    executor.spin_once(timeout_sec=5)
    assert calls == [future]


def test_a_context_destroys_the_nodes_that_it_tracks(domain_id):
    context = Context()
    context.init([], domain_id=domain_id)
    tracked, other = (rclpy.create_node(name, context=context) for name in ("tracked", "other"))
    context.track_node(tracked)
    context.track_node(other)
    context.untrack_node(other)
    context.destroy()
    with pytest.raises(InvalidHandle):
        tracked.create_publisher(String, "chatter", 1)
    assert not context.ok()
    other.destroy_node()


def test_shutdown_waits_for_the_threads_of_the_pool(context):
    before = set(threading.enumerate())
    executor = MultiThreadedExecutor(3, context=context)
    executor.create_task(lambda: None)
    executor.spin_once(timeout_sec=5)
    assert executor.shutdown()
    assert {thread for thread in set(threading.enumerate()) - before if thread.name.startswith("rclpy")} == set()


def test_rosout_has_the_profile_that_was_given(make_node, wait_until):
    profiles = {"given": QoSProfile(depth=7, lifespan=Duration(seconds=3)), "default": qos_profile_rosout_default}
    for name, profile in profiles.items():
        node = make_node(name, rosout_qos_profile=profile)
    wait_until(lambda: len(node.get_publishers_info_by_topic("/rosout")) == 2)
    lifespans = {info.node_name: info.qos_profile.lifespan for info in node.get_publishers_info_by_topic("/rosout")}
    assert lifespans == {name: profile.lifespan for name, profile in profiles.items()}
    assert QoSPresetProfiles.ROSOUT_DEFAULT.value == qos_profile_rosout_default


def test_signals_trigger_their_guard_conditions(domain_id):
    context = Context()
    rclpy.init(args=[], context=context, domain_id=domain_id, signal_handler_options=rclpy.SignalHandlerOptions.SIGINT)
    condition = SignalHandlerGuardCondition(context)
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
    assert condition._Coframe__remaining_ns() == 0
    condition.destroy()
    assert condition._Coframe__remaining_ns() is None
    rclpy.uninstall_signal_handlers()


def test_call_without_a_response_returns_none_up_to_jazzy(node, monkeypatch):
    monkeypatch.setattr("rclpy.client.since", lambda _: False)
    assert node.create_client(Trigger, "reset").call(Trigger.Request(), timeout_sec=0.05) is None


def test_call_without_a_response_raises_from_kilted_on(node, monkeypatch):
    monkeypatch.setattr("rclpy.client.since", lambda _: True)
    with pytest.raises(TimeoutError, match=r"no response from the service '/reset' within 0\.05 s"):
        node.create_client(Trigger, "reset").call(Trigger.Request(), timeout_sec=0.05)


@pytest.mark.parametrize(
    ("text", "pattern", "is_match"),
    [
        ("arm_left", "arm%", True),
        ("arm_left", "%left", True),
        ("arm_left", "a%_%t", True),
        ("arm", "a_m", True),
        ("arm", "arm%arm", False),
        ("armarm", "arm%arm", True),
        ("a", "a%a", False),
        ("", "%", True),
        ("x\ny", "x_y", True),
        ("a.b", "a?b", True),
        ("aXb", "a.b", False),
        ("abcabd", "%ab%d", True),
        ("a" * 20_000, "%a" * 100 + "b", False),
    ],
)
def test_patterns_of_content_filters(text, pattern, is_match):
    content_filter = ContentFilter(String, "data LIKE %0", [f"'{pattern}'"])
    begin = time.process_time()
    assert content_filter.accepts(String(data=text)) is is_match
    assert time.process_time() - begin < 2.0


@pytest.mark.parametrize(
    ("expression", "parameters", "error", "text"),
    [
        ("(" * 9000, [], RCLError, "more than 50 nested conditions"),
        ("data = '" + "a" * 20_000 + "'", [], RCLError, "more than 10000 characters"),
        ("data = %0", ["1" * 20_000], RCLError, "more than 10000 characters"),
        ("data = " + "9" * 5000, [], RCLError, "a number of more than 100 characters"),
        ("data[" + "9" * 5000 + "] = 1", [], RCLError, "not a field"),
        ("data = %0", [3], TypeError, "must be strings, got 3"),
        (None, [], TypeError, "must be strings, got None"),
        (b"data = 1", [], TypeError, "must be strings, got b'data = 1'"),
    ],
)
def test_hostile_content_filters(expression, parameters, error, text):
    with pytest.raises(error, match=text) as caught:
        ContentFilter(String, expression, parameters)
    assert len(str(caught.value)) < 400
