# SPDX-License-Identifier: Apache-2.0
"""tf2_ros.MessageFilter: waiting for transforms and reasons for dropped messages."""

import asyncio
import gc
import threading
import time
import weakref
from collections import Counter
from types import SimpleNamespace

import pytest

import rclpy
import tf2_ros
from builtin_interfaces.msg import Time as TimeMessage
from geometry_msgs.msg import Point, PointStamped
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from tf2_ros import FilterFailureReason, MessageFilter

LONG = 20.0
Reason = FilterFailureReason


def point(seconds, frame="laser"):
    message = PointStamped()
    message.header.frame_id = frame
    message.header.stamp = Time(seconds=seconds).to_msg()
    return message


def seconds_of(message):
    return message.header.stamp.sec + message.header.stamp.nanosec / 1e9


def until(condition, meanwhile=lambda: time.sleep(0.002)):
    deadline = time.monotonic() + LONG
    while not condition():
        assert time.monotonic() < deadline, "the condition did not come true in time"
        meanwhile()


class RecordingFilter:
    """A filter that records its passed and dropped messages."""

    def __init__(self, buffer, target_frames="base", queue_size=10, node=None, source=None, **options):
        self.passed = []
        self.dropped = []
        self.filter = MessageFilter(source, buffer, target_frames, queue_size, node, **options)
        self.filter.registerCallback(self.passed.append)
        self.filter.register_failure_callback(lambda *facts: self.dropped.append(facts))

    @property
    def stamps(self):
        return [seconds_of(message) for message in self.passed]

    @property
    def reasons(self):
        return [reason for _, reason, _ in self.dropped]


@pytest.fixture
def buffer():
    return tf2_ros.Buffer()


@pytest.fixture
def insert(buffer, stamped):
    """Return a function insert(seconds, parent, child) that inserts a transform."""
    return lambda seconds, parent="base", child="laser": buffer.set_transform(
        stamped(parent, child, seconds, (float(seconds), 0.0, 0.0)), "test"
    )


@pytest.fixture
def make_node(domain_id):
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    nodes = []

    def make(name="node"):
        nodes.append(Node(name, context=context, start_parameter_services=False))
        return nodes[-1]

    yield make
    for node in nodes:
        node.destroy_node()
    context.try_shutdown()


@pytest.fixture
def node(make_node):
    return make_node()


@pytest.fixture
def executor(node):
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    yield executor
    executor.shutdown()


class ManualBuffer(tf2_ros.Buffer):
    """A buffer whose waits the test completes in any order."""

    def __init__(self):
        super().__init__()
        self.futures = []

    def wait_for_transform_async(self, *query, timeout=None):
        del query, timeout
        self.futures.append(tf2_ros.Future())
        return self.futures[-1]


# Waiting for transforms


def test_message_waits_for_its_transform(buffer, insert):
    recording = RecordingFilter(buffer)
    insert(1)
    message = point(1.5)
    recording.filter.add(message)
    assert recording.passed == []
    insert(2)
    assert recording.passed == [message]
    assert buffer.lookup_transform("base", "laser", message.header.stamp).transform.translation.x == 1.5


def test_message_passes_immediately_if_its_transform_is_available(buffer, insert):
    recording = RecordingFilter(buffer)
    insert(1)
    recording.filter.add(point(1))
    recording.filter.add(point(9, frame="base"))  # is expressed in the target frame
    recording.filter.add(point(0))  # requests the latest transform
    assert recording.stamps == [1, 9, 0]
    assert recording.dropped == []


def test_messages_do_not_wait_for_each_other(buffer, insert):
    recording = RecordingFilter(buffer)
    insert(1)
    for message in (point(1, "nowhere"), point(3), point(1)):
        recording.filter.add(message)
    assert recording.stamps == [1]
    insert(3)
    assert recording.stamps == [1, 3]
    assert recording.filter.statistics.waiting == 1


def test_messages_released_by_one_transform_keep_their_order(stamped):
    buffer = ManualBuffer()
    recording = RecordingFilter(buffer)
    buffer.set_transform(stamped("base", "laser", 1), "test")
    for number in range(5):
        recording.filter.add(point(1.5 + number / 10))
    recording.filter.add(point(1.2))  # older than the others, but received last
    buffer.set_transform(stamped("base", "laser", 2), "test")
    for future in reversed(buffer.futures):
        future.set_result(None)
    assert recording.stamps == [1.2, 1.5, 1.6, 1.7, 1.8, 1.9]


def test_message_does_not_overtake_a_transformable_one(stamped):
    buffer = ManualBuffer()
    recording = RecordingFilter(buffer)
    buffer.set_transform(stamped("base", "laser", 1), "test")
    recording.filter.add(point(2))
    buffer.set_transform(stamped("base", "laser", 3), "test")
    recording.filter.add(point(2.5))  # received before the first one is found to be transformable
    assert recording.stamps == [2, 2.5]


def test_all_target_frames_are_required(buffer, insert):
    recording = RecordingFilter(buffer, ["base", "/map"])
    assert recording.filter.get_target_frames_string() == "base map"
    insert(1)
    insert(2)
    recording.filter.add(point(1.5))
    assert recording.passed == []
    insert(1, "map", "base")
    assert recording.passed == []
    insert(2, "map", "base")
    assert recording.stamps == [1.5]


def test_transform_that_is_no_longer_available_is_awaited_again(buffer, insert):
    recording = RecordingFilter(buffer, ["base", "map"])
    insert(1)
    recording.filter.add(point(1))
    buffer.clear()
    insert(1, "map", "base")
    assert recording.passed == []
    insert(1)
    assert recording.stamps == [1]


def test_new_target_frames_apply_to_waiting_messages(buffer, insert):
    recording = RecordingFilter(buffer, "nowhere")
    insert(1)
    recording.filter.add(point(1))
    recording.filter.add(point(2))
    recording.filter.set_target_frame("base")
    assert recording.stamps == [1]
    recording.filter.set_target_frames(["base", "map"])
    insert(2)
    assert recording.stamps == [1]
    buffer.set_transform_static(tf2_ros.TransformStamped(header=point(0, "map").header, child_frame_id="base"), "test")
    assert recording.stamps == [1, 2]


def test_tolerance_requires_later_transforms(buffer, insert):
    recording = RecordingFilter(buffer)
    recording.filter.set_tolerance(Duration(seconds=0.5))
    insert(1)
    recording.filter.add(point(1))
    recording.filter.add(point(0))
    assert recording.stamps == [0]
    insert(1.4)
    assert recording.stamps == [0]
    insert(1.5)
    assert recording.stamps == [0, 1]
    recording.filter.add(point(1.5))
    recording.filter.set_tolerance(Duration())
    assert recording.stamps == [0, 1, 1.5]


def test_leading_slashes_are_removed(buffer, insert):
    recording = RecordingFilter(buffer, "/base")
    insert(1)
    recording.filter.add(point(1, "/laser"))
    assert recording.stamps == [1]


def test_stamps_before_1970(buffer, stamped):
    recording = RecordingFilter(buffer)
    message = point(0)
    message.header.stamp = TimeMessage(sec=-5, nanosec=0)
    recording.filter.add(message)
    buffer.set_transform(stamped("base", "laser", -5.0), "test")
    assert recording.passed == [message]


# Reasons for dropped messages


def test_message_older_than_the_buffer(buffer, insert):
    recording = RecordingFilter(buffer, buffer_timeout=Duration(seconds=1000))
    insert(5)
    insert(6)
    message = point(4)
    recording.filter.add(message)
    assert recording.dropped == [
        (
            message,
            Reason.OutTheBack,
            (
                "Lookup would require extrapolation into the past.  Requested time 4.000000 but the earliest data is "
                "at time 5.000000, when looking up transform from frame [laser] to frame [base]. "
                "base -> laser no longer has a sample for the requested time. Use a longer cache, "
                'tf2_ros.Buffer(cache_time=Duration(seconds=30)) or coframe.Buffer(cache="30s"), '
                "or request a newer time. "
                "See doctor code TF015."
            ),
        )
    ]


def test_message_that_can_never_reach_one_target_is_dropped(buffer, insert):
    recording = RecordingFilter(buffer, ["nowhere", "base"])
    insert(5)
    recording.filter.add(point(4))
    assert recording.reasons == [Reason.OutTheBack]


def test_waiting_message_is_dropped_when_its_transform_becomes_unavailable(buffer, insert):
    recording = RecordingFilter(buffer)
    recording.filter.add(point(4))
    assert recording.dropped == []
    insert(5)
    insert(6)
    recording.filter.add(point(5))
    assert recording.reasons == [Reason.OutTheBack]
    assert recording.stamps == [5]


def test_header_without_a_frame(buffer):
    recording = RecordingFilter(buffer)
    recording.filter.add(point(1, ""))
    recording.filter.add(point(1, "/"))
    assert recording.reasons == [Reason.EmptyFrameID] * 2
    assert "Set header.frame_id" in recording.dropped[0][2]


def test_invalid_frame_name(buffer, insert):
    recording = RecordingFilter(buffer)
    insert(1)
    recording.filter.add(point(1, "//laser"))
    assert recording.reasons == [Reason.NoTransformFound]
    assert "cannot start with a '/'" in recording.dropped[0][2]
    assert "Remove the leading slash: " in recording.dropped[0][2]


def test_full_queue(buffer, insert):
    recording = RecordingFilter(buffer, queue_size=3)
    insert(1)
    for seconds in (2, 3, 4, 5):
        recording.filter.add(point(seconds))
    assert [(seconds_of(message), reason) for message, reason, _ in recording.dropped] == [(2, Reason.QueueFull)]
    assert recording.dropped[0][2].startswith(
        "Lookup would require extrapolation at time 2.000000, but only time 1.000000"
    )
    recording.filter.add(point(1))  # does not need to wait, so no message is dropped
    assert recording.filter.queue_size == 3
    recording.filter.queue_size = 1
    assert [seconds_of(message) for message, _, _ in recording.dropped] == [2, 3, 4]
    recording.filter.queue_size = 0
    for seconds in range(10, 1010):
        recording.filter.add(point(seconds))
    assert len(recording.dropped) == 3
    assert recording.stamps == [1]
    assert recording.filter.statistics == (1005, 1, {**dict.fromkeys(Reason, 0), Reason.QueueFull: 3}, 0, 1001)


def test_transformable_message_is_not_dropped_from_a_full_queue(stamped):
    buffer = ManualBuffer()
    recording = RecordingFilter(buffer, queue_size=1)
    recording.filter.add(point(1))
    buffer.set_transform(stamped("base", "laser", 1), "test")
    recording.filter.add(point(9))
    assert recording.stamps == [1]
    assert recording.dropped == []


def test_timeout(buffer, insert):
    recording = RecordingFilter(buffer, buffer_timeout=Duration(seconds=0.05))
    insert(1)
    insert(2)
    dropped = threading.Event()
    recording.filter.register_failure_callback(lambda *_: dropped.set())
    begin = time.monotonic()
    recording.filter.add(point(3))
    assert recording.dropped == []
    assert dropped.wait(LONG)
    assert time.monotonic() - begin >= 0.05
    assert recording.reasons == [Reason.TimedOut]
    assert "Requested time 3.000000 but the latest data is at time 2.000000" in recording.dropped[0][2]
    assert "base -> laser has no sample for the requested time yet" in recording.dropped[0][2]
    insert(3)
    assert recording.passed == []


def test_wait_cancelled_from_outside():
    buffer = ManualBuffer()
    recording = RecordingFilter(buffer)
    recording.filter.add(point(1))
    buffer.futures[0].cancel()
    assert recording.reasons == [Reason.Unknown]


def test_values_of_reasons():
    assert [(reason.name, reason.value) for reason in Reason] == [
        ("Unknown", 0),
        ("OutTheBack", 1),
        ("EmptyFrameID", 2),
        ("NoTransformFound", 3),
        ("QueueFull", 4),
        ("TimedOut", 5),
    ]


def test_failure_callback_without_explanation(buffer):
    recording, facts = RecordingFilter(buffer), []
    recording.filter.registerFailureCallback(lambda message, reason: facts.append((message, reason)))
    message = point(1, "")
    recording.filter.add(message)
    assert facts == [(message, Reason.EmptyFrameID)]


def test_throttled_warning_about_dropped_messages(buffer, insert, capfd):
    recording = RecordingFilter(buffer, ["base", "map"])
    insert(5)
    recording.filter.add(point(5, "base"))
    recording.filter.add(point(4.25))
    for _ in range(10):
        recording.filter.add(point(4))
    lines = [line for line in capfd.readouterr().err.splitlines() if "MessageFilter" in line]
    assert len(lines) == 1
    assert "MessageFilter [target=base map]: Dropped 100.00% of messages so far (OutTheBack: 1). " in lines[0]
    assert "The last one, of frame 'laser' at 4.250000: OutTheBack, Lookup would require" in lines[0]


# Callbacks


def test_callbacks_with_arguments_and_chains_of_filters(buffer, insert):
    first = MessageFilter(None, buffer, "base", 10)
    second, got = MessageFilter(first, buffer, "map", 10), []
    second.registerCallback(lambda *arguments: got.append(arguments), "extra", 7)
    message = point(1)
    first.add(message)
    insert(1)
    assert got == []
    insert(1, "map", "base")
    assert got == [(message, "extra", 7)]


def test_without_a_node_exceptions_of_callbacks_are_printed(buffer, insert, capsys):
    recording = RecordingFilter(buffer)
    recording.filter.registerCallback(lambda _: 1 / 0)
    recording.filter.add(point(1))
    recording.filter.add(point(1))
    insert(1)
    assert recording.stamps == [1, 1]
    assert capsys.readouterr().err.count("ZeroDivisionError") == 2
    recording.filter.add(point(1))
    assert recording.stamps == [1, 1, 1]


def test_without_a_node_callbacks_do_not_overlap(buffer, insert):
    recording = RecordingFilter(buffer)
    inside, go_on, threads = threading.Event(), threading.Event(), []

    def slow(_):
        threads.append(threading.current_thread())
        inside.set()
        go_on.wait(LONG)

    recording.filter.registerCallback(slow)
    insert(1)
    other = threading.Thread(target=recording.filter.add, args=(point(1),))
    other.start()
    assert inside.wait(LONG)
    recording.filter.add(point(1))  # returns immediately, because the other thread delivers the message
    assert len(threads) == 1
    go_on.set()
    other.join(LONG)
    assert threads == [other, other]
    assert recording.stamps == [1, 1]


def test_callback_that_uses_the_filter_and_the_buffer(buffer, insert):
    recording = RecordingFilter(buffer)

    def again(message):
        if seconds_of(message) < 3:
            recording.filter.add(point(seconds_of(message) + 1))
            insert(seconds_of(message) + 1)
            recording.filter.set_target_frame("base")

    recording.filter.registerCallback(again)
    recording.filter.add(point(1))
    insert(1)
    assert recording.stamps == [1, 2, 3]


def test_with_a_node_callbacks_run_in_its_executor(buffer, insert, node, executor):
    recording, threads = RecordingFilter(buffer, node=node), []
    recording.filter.registerCallback(lambda _: threads.append(threading.current_thread()))
    recording.filter.register_failure_callback(lambda *_: threads.append(threading.current_thread()))

    def elsewhere():
        recording.filter.add(point(1))
        insert(1)
        recording.filter.add(point(0.5))

    thread = threading.Thread(target=elsewhere)
    thread.start()
    thread.join()
    assert recording.passed == []
    assert recording.filter.statistics.waiting == 1
    until(lambda: len(threads) == 2, lambda: executor.spin_once(timeout_sec=1))
    assert set(threads) == {threading.current_thread()}
    assert recording.stamps == [1]
    assert recording.reasons == [Reason.OutTheBack]


def test_spin_raises_exceptions_of_callbacks(buffer, insert, node, executor):
    recording = RecordingFilter(buffer, node=node)
    recording.filter.registerCallback(lambda _: 1 / 0)
    insert(1)
    for _ in range(3):
        recording.filter.add(point(1))
    for _ in range(3):
        with pytest.raises(ZeroDivisionError):
            executor.spin_once(timeout_sec=1)
    assert recording.stamps == [1, 1, 1]


def test_coroutine_callbacks(buffer, insert, node, executor):
    found = []
    recording = RecordingFilter(buffer, node=node)

    async def callback(message):
        found.append(await buffer.lookup_transform_async("map", "laser", message.header.stamp))

    recording.filter.registerCallback(callback)
    insert(1)
    recording.filter.add(point(1))
    until(lambda: recording.passed, lambda: executor.spin_once(timeout_sec=1))
    insert(1, "map", "base")
    until(lambda: found, lambda: executor.spin_once(timeout_sec=1))


def test_other_callbacks_of_the_node_are_not_starved(buffer, insert, node, executor):
    recording, order = RecordingFilter(buffer, node=node), []
    recording.filter.registerCallback(lambda _: order.append("message"))
    guard = node.create_guard_condition(lambda: order.append("other"))
    insert(1)
    for _ in range(5):
        recording.filter.add(point(1))
    guard.trigger()
    until(lambda: len(order) == 6, lambda: executor.spin_once(timeout_sec=1))
    assert order.index("other") < 2


# Messages from the wire


def test_messages_and_transforms_from_the_wire(make_node, node, executor, stamped):
    buffer = tf2_ros.Buffer()
    listener = tf2_ros.TransformListener(buffer, node)
    recording = RecordingFilter(buffer, node=node, source=(PointStamped, "points", qos_profile_sensor_data))
    talker = make_node("talker")
    publisher = talker.create_publisher(PointStamped, "points", 10)
    broadcaster = tf2_ros.TransformBroadcaster(talker)
    until(lambda: publisher.get_subscription_count() and broadcaster.pub_tf.get_subscription_count())
    until(listener.tf_sub.get_publisher_count)
    for seconds in (1.2, 1.4):
        publisher.publish(point(seconds))
    until(lambda: recording.filter.statistics.received == 2, lambda: executor.spin_once(timeout_sec=0.1))
    assert recording.passed == []
    broadcaster.sendTransform([stamped("base", "laser", 1.0), stamped("base", "laser", 2.0)])
    until(lambda: len(recording.passed) == 2, lambda: executor.spin_once(timeout_sec=0.1))
    assert recording.stamps == [1.2, 1.4]
    publisher.publish(point(0.5))
    until(lambda: recording.dropped, lambda: executor.spin_once(timeout_sec=0.1))
    assert recording.reasons == [Reason.OutTheBack]
    recording.filter.destroy()
    until(lambda: not publisher.get_subscription_count())


def test_received_messages_do_not_starve_deliveries(make_node, node):
    """A thread pool runs one callback of a group at a time, and there is always another message to receive."""
    pool, waiting = MultiThreadedExecutor(2, context=node.context), []
    pool.add_node(node)
    recording = RecordingFilter(tf2_ros.Buffer(), node=node, source=(PointStamped, "points", 1000))
    recording.filter.registerCallback(lambda _: waiting.append(recording.filter.statistics.waiting))
    publisher = make_node("talker").create_publisher(PointStamped, "points", 1000)
    until(publisher.get_subscription_count)
    for _ in range(300):
        publisher.publish(point(1, "base"))
    thread = threading.Thread(target=pool.spin)
    thread.start()
    until(lambda: len(waiting) == 300)
    pool.shutdown(timeout_sec=LONG)
    thread.join(LONG)
    assert max(waiting) < 5


# Many messages


@pytest.mark.parametrize("is_spun", [False, True], ids=["without a node", "with a node"])
def test_ten_thousand_messages(request, stamped, is_spun):
    """Two threads add messages and two insert transforms. Each message is delivered once."""
    count = 10_000
    buffer = tf2_ros.Buffer(Duration(seconds=1000))
    node = request.getfixturevalue("node") if is_spun else None
    recording = RecordingFilter(buffer, ["base", "map"], 0, node)
    added, inserted = [0, 0], [0, 0]

    def feed(me):
        for number in range(me, count, 2):
            until(lambda number=number: number < min(inserted) + 200)  # limits the backlog, as a real sensor would
            recording.filter.add(point(1.0 + number / 1000))
            added[me] = number

    def broadcast(me, parent, child, step):
        for number in range(0, count + step, step):
            until(lambda number=number: number < min(added) + 100 or number >= count - 200)
            buffer.set_transform(stamped(parent, child, 1.0 + number / 1000), "test")
            inserted[me] = number

    threads = [
        threading.Thread(target=feed, args=(0,)),
        threading.Thread(target=feed, args=(1,)),
        threading.Thread(target=broadcast, args=(0, "map", "base", 20)),
        threading.Thread(target=broadcast, args=(1, "base", "laser", 25)),
    ]
    if node is not None:
        executor = SingleThreadedExecutor(context=node.context)
        executor.add_node(node)
        threads.append(threading.Thread(target=executor.spin))
    for thread in threads:
        thread.start()
    until(lambda: len(recording.passed) >= count)
    if node is not None:
        executor.shutdown(timeout_sec=LONG)
    for thread in threads:
        thread.join(LONG)
        assert not thread.is_alive()
    assert Counter(round((seconds - 1.0) * 1000) for seconds in recording.stamps) == Counter(range(count))
    assert recording.dropped == []
    assert recording.filter.statistics == (count, count, dict.fromkeys(Reason, 0), 0, 0)


def test_statistics_are_consistent(buffer, insert):
    """Use a short queue, a short timeout and all kinds of messages."""
    recording = RecordingFilter(buffer, queue_size=4, buffer_timeout=Duration(seconds=0.01))
    insert(5)
    kinds = [point(5), point(4), point(6), point(7), point(1, ""), point(1, "//x"), point(1, "nowhere")]

    def feed():
        for message in kinds * 50:
            recording.filter.add(message)

    threads = [threading.Thread(target=feed) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(LONG)
    until(lambda: recording.filter.statistics.waiting == 0)
    received, passed, dropped, cleared, _ = recording.filter.statistics
    assert (received, passed, cleared) == (700, 100, 0)
    assert dropped == {reason: recording.reasons.count(reason) for reason in Reason}
    assert dropped[Reason.OutTheBack] == dropped[Reason.EmptyFrameID] == dropped[Reason.NoTransformFound] == 100
    assert dropped[Reason.QueueFull] + dropped[Reason.TimedOut] == 300
    assert 0 < dropped[Reason.TimedOut] <= 300


def test_waiting_takes_one_thread_at_most(buffer):
    before = threading.active_count()
    recording = RecordingFilter(buffer, queue_size=0, buffer_timeout=Duration(seconds=1000))
    for _ in range(100):
        recording.filter.add(point(1))
    assert threading.active_count() <= before + 1
    recording.filter.destroy()


# Clearing and destruction


def test_clear_removes_waiting_messages(buffer, insert, node, executor):
    recording = RecordingFilter(buffer, node=node)
    insert(1)
    recording.filter.add(point(1))
    recording.filter.add(point(0.5))
    recording.filter.add(point(2))
    recording.filter.clear()
    insert(2)
    until(lambda: recording.dropped, lambda: executor.spin_once(timeout_sec=1))
    executor.spin_once(timeout_sec=0)
    assert recording.passed == []
    assert recording.filter.statistics == (3, 0, {**dict.fromkeys(Reason, 0), Reason.OutTheBack: 1}, 2, 0)
    recording.filter.add(point(2))
    until(lambda: recording.passed, lambda: executor.spin_once(timeout_sec=1))


def test_destroy_with_waiting_messages(buffer, insert, node, executor):
    recording = RecordingFilter(buffer, node=node, buffer_timeout=Duration(seconds=0.01))
    recording.filter.add(point(1))
    recording.filter.destroy()
    recording.filter.destroy()
    insert(1)
    recording.filter.add(point(1))
    executor.spin_once(timeout_sec=0)
    assert (recording.passed, recording.dropped) == ([], [])
    assert recording.filter.statistics == (1, 0, dict.fromkeys(Reason, 0), 1, 0)


def test_waits_of_deleted_filters_are_removed():
    buffer = ManualBuffer()
    recording = RecordingFilter(buffer, queue_size=1)
    recording.filter.add(point(1))
    recording.filter.add(point(2))
    recording.filter.set_target_frame("map")
    recording.filter.clear()
    assert [future.cancelled() for future in buffer.futures] == [True] * 3
    begin_to_wait = buffer.wait_for_transform_async

    def meanwhile(*query, timeout=None):
        recording.filter.clear()
        return begin_to_wait(*query, timeout=timeout)

    buffer.wait_for_transform_async = meanwhile
    recording.filter.add(point(3))
    assert buffer.futures[3].cancelled()


def test_node_destroyed_before_the_filter(buffer, insert, node):
    recording = RecordingFilter(buffer, node=node, source=(PointStamped, "points", 10))
    recording.filter.add(point(1))
    node.destroy_node()
    insert(1)
    recording.filter.destroy()
    assert recording.passed == []


def test_clearing_the_buffer(buffer, insert):
    recording = RecordingFilter(buffer)
    insert(1)
    recording.filter.add(point(2))
    buffer.clear()
    recording.filter.add(point(3))
    assert recording.dropped == []
    insert(2)
    insert(3)
    assert recording.stamps == [2, 3]


class Message:
    """A message with a weak reference."""

    def __init__(self, seconds, frame="laser"):
        self.header = point(seconds, frame).header


def test_messages_are_released(buffer, insert):
    recording = MessageFilter(None, buffer, "base", 2)
    alive = weakref.WeakSet()

    def add(*messages):
        for message in messages:
            alive.add(message)
            recording.add(message)

    insert(1)
    add(Message(1), Message(0.5), Message(1, ""), Message(2), Message(3), Message(4))
    gc.collect()
    assert {message.header.stamp.sec for message in alive} == {3, 4}
    insert(3)
    gc.collect()
    assert {message.header.stamp.sec for message in alive} == {4}
    recording.clear()
    gc.collect()
    assert len(alive) == 0


def test_unreferenced_filter_is_released_with_its_messages(buffer, insert):
    recording, message = MessageFilter(None, buffer, "base", 10), Message(1)
    passed = []
    recording.registerCallback(passed.append)
    recording.add(message)
    gone = weakref.ref(recording), weakref.ref(message)
    del recording, message
    gc.collect()
    assert [reference() for reference in gone] == [None, None]
    insert(1)
    assert passed == []


# Invalid arguments


def test_messages_without_a_header(buffer, node):
    recording = RecordingFilter(buffer)
    with pytest.raises(TypeError, match=r"Point has no header with a frame_id and a stamp.* PointStamped"):
        recording.filter.add(Point())
    with pytest.raises(TypeError, match="Point has no header"):
        MessageFilter((Point, "points", 10), buffer, "base", 10, node)
    with pytest.raises(TypeError, match=r"header.frame_id must be str, not NoneType"):
        recording.filter.add(SimpleNamespace(header=SimpleNamespace(frame_id=None, stamp=Time())))
    with pytest.raises(TypeError, match="time must have sec and nanosec, or nanoseconds"):
        recording.filter.add(SimpleNamespace(header=SimpleNamespace(frame_id="a", stamp=1.5)))
    assert recording.filter.statistics.received == 0


@pytest.mark.parametrize(
    ("arguments", "options", "error"),
    [
        (((PointStamped, "points", 10), "base", 10), {}, "The subscription to 'points' requires a node"),
        ((PointStamped, "base", 10), {}, "Invalid subscriber"),
        ((None, "base", 10.0), {}, "queue_size must be an int, not float"),
        ((None, 7, 10), {}, "not iterable"),
        ((None, [7], 10), {}, "a target frame must be str, not int"),
        ((None, "base", 10), {"buffer_timeout": 0.1}, r"buffer_timeout must be an rclpy Duration, not float"),
        ((None, "base", 10), {"callback_group": object()}, "A callback group requires a node"),
    ],
)
def test_arguments_of_wrong_types(buffer, arguments, options, error):
    subscriber, *others = arguments
    with pytest.raises(TypeError, match=error):
        MessageFilter(subscriber, buffer, *others, **options)


def test_invalid_values(buffer):
    with pytest.raises(ValueError, match="at least one target frame"):
        MessageFilter(None, buffer, [], 10)
    with pytest.raises(ValueError, match="queue_size must not be negative, but is -1"):
        MessageFilter(None, buffer, "base", -1)
    recording = RecordingFilter(buffer)
    with pytest.raises(TypeError, match="The callback must be a function, not None"):
        recording.filter.registerCallback(None)
    with pytest.raises(TypeError, match="A coroutine function requires a node"):
        recording.filter.registerCallback(asyncio.sleep)
    with pytest.raises(TypeError, match="tolerance must be an rclpy Duration, not int"):
        recording.filter.set_tolerance(1)
