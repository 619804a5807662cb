"""tf2_ros.MessageFilter: messages wait for their transforms, and drops have reasons."""

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


class Kept:
    """A filter and what came out of it."""

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
    """Tells the buffer where a frame was: insert(seconds, parent, child)."""
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


class OwnWaits(tf2_ros.Buffer):
    """A buffer whose waits the test completes, in whatever order."""

    def __init__(self):
        super().__init__()
        self.futures = []

    def wait_for_transform_async(self, *query, timeout=None):
        del query, timeout
        self.futures.append(tf2_ros.Future())
        return self.futures[-1]


# Waiting


def test_a_message_waits_for_its_transform(buffer, insert):
    kept = Kept(buffer)
    insert(1)
    message = point(1.5)
    kept.filter.add(message)
    assert kept.passed == []
    insert(2)
    assert kept.passed == [message]
    assert buffer.lookup_transform("base", "laser", message.header.stamp).transform.translation.x == 1.5


def test_a_message_whose_transform_is_there_passes_at_once(buffer, insert):
    kept = Kept(buffer)
    insert(1)
    kept.filter.add(point(1))
    kept.filter.add(point(9, frame="base"))  # is where it shall be already
    kept.filter.add(point(0))  # asks for the latest
    assert kept.stamps == [1, 9, 0]
    assert kept.dropped == []


def test_nobody_waits_behind_another(buffer, insert):
    kept = Kept(buffer)
    insert(1)
    for message in (point(1, "nowhere"), point(3), point(1)):
        kept.filter.add(message)
    assert kept.stamps == [1]
    insert(3)
    assert kept.stamps == [1, 3]
    assert kept.filter.statistics.waiting == 1


def test_what_one_transform_lets_through_goes_in_order(stamped):
    buffer = OwnWaits()
    kept = Kept(buffer)
    buffer.set_transform(stamped("base", "laser", 1), "test")
    for number in range(5):
        kept.filter.add(point(1.5 + number / 10))
    kept.filter.add(point(1.2))  # older than the others, but it came last
    buffer.set_transform(stamped("base", "laser", 2), "test")
    for future in reversed(buffer.futures):
        future.set_result(None)
    assert kept.stamps == [1.2, 1.5, 1.6, 1.7, 1.8, 1.9]


def test_no_message_overtakes_one_that_may_go_as_well(stamped):
    buffer = OwnWaits()
    kept = Kept(buffer)
    buffer.set_transform(stamped("base", "laser", 1), "test")
    kept.filter.add(point(2))
    buffer.set_transform(stamped("base", "laser", 3), "test")
    kept.filter.add(point(2.5))  # comes before anybody has noticed that the first can go
    assert kept.stamps == [2, 2.5]


def test_all_target_frames_must_be_there(buffer, insert):
    kept = Kept(buffer, ["base", "/map"])
    assert kept.filter.get_target_frames_string() == "base map"
    insert(1)
    insert(2)
    kept.filter.add(point(1.5))
    assert kept.passed == []
    insert(1, "map", "base")
    assert kept.passed == []
    insert(2, "map", "base")
    assert kept.stamps == [1.5]


def test_a_transform_that_was_there_and_is_gone_is_waited_for_again(buffer, insert):
    kept = Kept(buffer, ["base", "map"])
    insert(1)
    kept.filter.add(point(1))
    buffer.clear()
    insert(1, "map", "base")
    assert kept.passed == []
    insert(1)
    assert kept.stamps == [1]


def test_other_target_frames_hold_for_those_that_wait(buffer, insert):
    kept = Kept(buffer, "nowhere")
    insert(1)
    kept.filter.add(point(1))
    kept.filter.add(point(2))
    kept.filter.set_target_frame("base")
    assert kept.stamps == [1]
    kept.filter.set_target_frames(["base", "map"])
    insert(2)
    assert kept.stamps == [1]
    buffer.set_transform_static(tf2_ros.TransformStamped(header=point(0, "map").header, child_frame_id="base"), "test")
    assert kept.stamps == [1, 2]


def test_tolerance_asks_for_the_time_after_as_well(buffer, insert):
    kept = Kept(buffer)
    kept.filter.set_tolerance(Duration(seconds=0.5))
    insert(1)
    kept.filter.add(point(1))
    kept.filter.add(point(0))
    assert kept.stamps == [0]
    insert(1.4)
    assert kept.stamps == [0]
    insert(1.5)
    assert kept.stamps == [0, 1]
    kept.filter.add(point(1.5))
    kept.filter.set_tolerance(Duration())
    assert kept.stamps == [0, 1, 1.5]


def test_slashes_of_ros_1_are_taken_off(buffer, insert):
    kept = Kept(buffer, "/base")
    insert(1)
    kept.filter.add(point(1, "/laser"))
    assert kept.stamps == [1]


def test_stamps_before_1970(buffer, stamped):
    kept = Kept(buffer)
    message = point(0)
    message.header.stamp = TimeMessage(sec=-5, nanosec=0)
    kept.filter.add(message)
    buffer.set_transform(stamped("base", "laser", -5.0), "test")
    assert kept.passed == [message]


# Reasons to drop


def test_older_than_the_whole_cache(buffer, insert):
    kept = Kept(buffer, buffer_timeout=Duration(seconds=1000))
    insert(5)
    insert(6)
    message = point(4)
    kept.filter.add(message)
    assert kept.dropped == [
        (
            message,
            Reason.OutTheBack,
            (
                "Lookup would require extrapolation into the past.  Requested time 4.000000 but the earliest data is "
                "at time 5.000000, when looking up transform from frame [laser] to frame [base] "
                "base -> laser no longer has a sample for the requested time. Use a longer cache, "
                'tf2_ros.Buffer(cache_time=Duration(seconds=30)) or coframe.Buffer(cache="30s"), '
                "or request a newer time. "
                "See doctor code TF015."
            ),
        )
    ]


def test_hopeless_for_one_target_is_hopeless(buffer, insert):
    kept = Kept(buffer, ["nowhere", "base"])
    insert(5)
    kept.filter.add(point(4))
    assert kept.reasons == [Reason.OutTheBack]


def test_a_message_that_waited_in_vain_goes_when_the_next_gets_through(buffer, insert):
    kept = Kept(buffer)
    kept.filter.add(point(4))
    assert kept.dropped == []
    insert(5)
    insert(6)
    kept.filter.add(point(5))
    assert kept.reasons == [Reason.OutTheBack]
    assert kept.stamps == [5]


def test_a_header_without_a_frame(buffer):
    kept = Kept(buffer)
    kept.filter.add(point(1, ""))
    kept.filter.add(point(1, "/"))
    assert kept.reasons == [Reason.EmptyFrameID] * 2
    assert "set header.frame_id" in kept.dropped[0][2]


def test_a_frame_that_cannot_exist(buffer, insert):
    kept = Kept(buffer)
    insert(1)
    kept.filter.add(point(1, "//laser"))
    assert kept.reasons == [Reason.NoTransformFound]
    assert "cannot start with a '/'" in kept.dropped[0][2]
    assert "Remove the leading slash: " in kept.dropped[0][2]


def test_the_queue_has_an_end(buffer, insert):
    kept = Kept(buffer, queue_size=3)
    insert(1)
    for seconds in (2, 3, 4, 5):
        kept.filter.add(point(seconds))
    assert [(seconds_of(message), reason) for message, reason, _ in kept.dropped] == [(2, Reason.QueueFull)]
    assert kept.dropped[0][2].startswith("Lookup would require extrapolation at time 2.000000, but only time 1.000000")
    kept.filter.add(point(1))  # need not wait, so nobody has to make room
    assert kept.filter.queue_size == 3
    kept.filter.queue_size = 1
    assert [seconds_of(message) for message, _, _ in kept.dropped] == [2, 3, 4]
    kept.filter.queue_size = 0
    for seconds in range(10, 1010):
        kept.filter.add(point(seconds))
    assert len(kept.dropped) == 3
    assert kept.stamps == [1]
    assert kept.filter.statistics == (1005, 1, {**dict.fromkeys(Reason, 0), Reason.QueueFull: 3}, 0, 1001)


def test_who_can_go_is_not_dropped_for_want_of_room(stamped):
    buffer = OwnWaits()
    kept = Kept(buffer, queue_size=1)
    kept.filter.add(point(1))
    buffer.set_transform(stamped("base", "laser", 1), "test")
    kept.filter.add(point(9))
    assert kept.stamps == [1]
    assert kept.dropped == []


def test_time_is_over_while_no_transform_comes(buffer, insert):
    kept = Kept(buffer, buffer_timeout=Duration(seconds=0.05))
    insert(1)
    insert(2)
    told = threading.Event()
    kept.filter.register_failure_callback(lambda *_: told.set())
    begin = time.monotonic()
    kept.filter.add(point(3))
    assert kept.dropped == []
    assert told.wait(LONG)
    assert time.monotonic() - begin >= 0.05
    assert kept.reasons == [Reason.TimedOut]
    assert "Requested time 3.000000 but the latest data is at time 2.000000" in kept.dropped[0][2]
    assert "base -> laser has no sample for the requested time yet" in kept.dropped[0][2]
    insert(3)
    assert kept.passed == []


def test_somebody_else_cancels_the_wait():
    buffer = OwnWaits()
    kept = Kept(buffer)
    kept.filter.add(point(1))
    buffer.futures[0].cancel()
    assert kept.reasons == [Reason.Unknown]


def test_reasons_have_the_numbers_of_c_plus_plus():
    assert [(reason.name, reason.value) for reason in Reason] == [
        ("Unknown", 0),
        ("OutTheBack", 1),
        ("EmptyFrameID", 2),
        ("NoTransformFound", 3),
        ("QueueFull", 4),
        ("TimedOut", 5),
    ]


def test_a_failure_callback_may_do_without_the_explanation(buffer):
    kept, facts = Kept(buffer), []
    kept.filter.registerFailureCallback(lambda message, reason: facts.append((message, reason)))
    message = point(1, "")
    kept.filter.add(message)
    assert facts == [(message, Reason.EmptyFrameID)]


def test_drops_are_told_of_in_the_log_but_not_each(buffer, insert, capfd):
    kept = Kept(buffer, ["base", "map"])
    insert(5)
    kept.filter.add(point(5, "base"))
    kept.filter.add(point(4.25))
    for _ in range(10):
        kept.filter.add(point(4))
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


def test_without_a_node_a_callback_that_raises_is_reported(buffer, insert, capsys):
    kept = Kept(buffer)
    kept.filter.registerCallback(lambda _: 1 / 0)
    kept.filter.add(point(1))
    kept.filter.add(point(1))
    insert(1)
    assert kept.stamps == [1, 1]
    assert capsys.readouterr().err.count("ZeroDivisionError") == 2
    kept.filter.add(point(1))
    assert kept.stamps == [1, 1, 1]


def test_without_a_node_callbacks_do_not_overlap(buffer, insert):
    kept = Kept(buffer)
    inside, go_on, threads = threading.Event(), threading.Event(), []

    def slow(_):
        threads.append(threading.current_thread())
        inside.set()
        go_on.wait(LONG)

    kept.filter.registerCallback(slow)
    insert(1)
    other = threading.Thread(target=kept.filter.add, args=(point(1),))
    other.start()
    assert inside.wait(LONG)
    kept.filter.add(point(1))  # comes back at once: the other thread sees to it
    assert len(threads) == 1
    go_on.set()
    other.join(LONG)
    assert threads == [other, other]
    assert kept.stamps == [1, 1]


def test_a_callback_may_use_the_filter_and_the_buffer(buffer, insert):
    kept = Kept(buffer)

    def again(message):
        if seconds_of(message) < 3:
            kept.filter.add(point(seconds_of(message) + 1))
            insert(seconds_of(message) + 1)
            kept.filter.set_target_frame("base")

    kept.filter.registerCallback(again)
    kept.filter.add(point(1))
    insert(1)
    assert kept.stamps == [1, 2, 3]


def test_with_a_node_callbacks_run_where_it_is_spun(buffer, insert, node, executor):
    kept, threads = Kept(buffer, node=node), []
    kept.filter.registerCallback(lambda _: threads.append(threading.current_thread()))
    kept.filter.register_failure_callback(lambda *_: threads.append(threading.current_thread()))

    def elsewhere():
        kept.filter.add(point(1))
        insert(1)
        kept.filter.add(point(0.5))

    thread = threading.Thread(target=elsewhere)
    thread.start()
    thread.join()
    assert kept.passed == []
    assert kept.filter.statistics.waiting == 1
    until(lambda: len(threads) == 2, lambda: executor.spin_once(timeout_sec=1))
    assert set(threads) == {threading.current_thread()}
    assert kept.stamps == [1]
    assert kept.reasons == [Reason.OutTheBack]


def test_what_a_callback_raises_reaches_the_spinner(buffer, insert, node, executor):
    kept = Kept(buffer, node=node)
    kept.filter.registerCallback(lambda _: 1 / 0)
    insert(1)
    for _ in range(3):
        kept.filter.add(point(1))
    for _ in range(3):
        with pytest.raises(ZeroDivisionError):
            executor.spin_once(timeout_sec=1)
    assert kept.stamps == [1, 1, 1]


def test_coroutine_callbacks(buffer, insert, node, executor):
    found = []
    kept = Kept(buffer, node=node)

    async def callback(message):
        found.append(await buffer.lookup_transform_async("map", "laser", message.header.stamp))

    kept.filter.registerCallback(callback)
    insert(1)
    kept.filter.add(point(1))
    until(lambda: kept.passed, lambda: executor.spin_once(timeout_sec=1))
    insert(1, "map", "base")
    until(lambda: found, lambda: executor.spin_once(timeout_sec=1))


def test_other_callbacks_of_the_node_have_their_turns(buffer, insert, node, executor):
    kept, order = Kept(buffer, node=node), []
    kept.filter.registerCallback(lambda _: order.append("message"))
    guard = node.create_guard_condition(lambda: order.append("other"))
    insert(1)
    for _ in range(5):
        kept.filter.add(point(1))
    guard.trigger()
    until(lambda: len(order) == 6, lambda: executor.spin_once(timeout_sec=1))
    assert order.index("other") < 2


# From the wire


def test_messages_and_transforms_from_the_wire(make_node, node, executor, stamped):
    buffer = tf2_ros.Buffer()
    listener = tf2_ros.TransformListener(buffer, node)
    kept = Kept(buffer, node=node, source=(PointStamped, "points", qos_profile_sensor_data))
    talker = make_node("talker")
    publisher = talker.create_publisher(PointStamped, "points", 10)
    broadcaster = tf2_ros.TransformBroadcaster(talker)
    until(lambda: publisher.get_subscription_count() and broadcaster.pub_tf.get_subscription_count())
    until(listener.tf_sub.get_publisher_count)
    for seconds in (1.2, 1.4):
        publisher.publish(point(seconds))
    until(lambda: kept.filter.statistics.received == 2, lambda: executor.spin_once(timeout_sec=0.1))
    assert kept.passed == []
    broadcaster.sendTransform([stamped("base", "laser", 1.0), stamped("base", "laser", 2.0)])
    until(lambda: len(kept.passed) == 2, lambda: executor.spin_once(timeout_sec=0.1))
    assert kept.stamps == [1.2, 1.4]
    publisher.publish(point(0.5))
    until(lambda: kept.dropped, lambda: executor.spin_once(timeout_sec=0.1))
    assert kept.reasons == [Reason.OutTheBack]
    kept.filter.destroy()
    until(lambda: not publisher.get_subscription_count())


def test_what_comes_in_does_not_pile_up_before_what_goes_out(make_node, node):
    """A pool of threads runs one callback of a group at a time, and there is always one more message to receive."""
    pool, waiting = MultiThreadedExecutor(2, context=node.context), []
    pool.add_node(node)
    kept = Kept(tf2_ros.Buffer(), node=node, source=(PointStamped, "points", 1000))
    kept.filter.registerCallback(lambda _: waiting.append(kept.filter.statistics.waiting))
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
    """Two threads bring messages, two bring transforms; each message comes out once."""
    count = 10_000
    buffer = tf2_ros.Buffer(Duration(seconds=1000))
    node = request.getfixturevalue("node") if is_spun else None
    kept = Kept(buffer, ["base", "map"], 0, node)
    fed, told = [0, 0], [0, 0]

    def feed(me):
        for number in range(me, count, 2):
            until(lambda number=number: number < min(told) + 200)  # as a sensor, which knows no backlog without end
            kept.filter.add(point(1.0 + number / 1000))
            fed[me] = number

    def broadcast(me, parent, child, step):
        for number in range(0, count + step, step):
            until(lambda number=number: number < min(fed) + 100 or number >= count - 200)
            buffer.set_transform(stamped(parent, child, 1.0 + number / 1000), "test")
            told[me] = number

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
    until(lambda: len(kept.passed) >= count)
    if node is not None:
        executor.shutdown(timeout_sec=LONG)
    for thread in threads:
        thread.join(LONG)
        assert not thread.is_alive()
    assert Counter(round((seconds - 1.0) * 1000) for seconds in kept.stamps) == Counter(range(count))
    assert kept.dropped == []
    assert kept.filter.statistics == (count, count, dict.fromkeys(Reason, 0), 0, 0)


def test_the_sums_are_right_whatever_happens(buffer, insert):
    """Short queue, short time, messages of every kind."""
    kept = Kept(buffer, queue_size=4, buffer_timeout=Duration(seconds=0.01))
    insert(5)
    kinds = [point(5), point(4), point(6), point(7), point(1, ""), point(1, "//x"), point(1, "nowhere")]

    def feed():
        for message in kinds * 50:
            kept.filter.add(message)

    threads = [threading.Thread(target=feed) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(LONG)
    until(lambda: kept.filter.statistics.waiting == 0)
    received, passed, dropped, cleared, _ = kept.filter.statistics
    assert (received, passed, cleared) == (700, 100, 0)
    assert dropped == {reason: kept.reasons.count(reason) for reason in Reason}
    assert dropped[Reason.OutTheBack] == dropped[Reason.EmptyFrameID] == dropped[Reason.NoTransformFound] == 100
    assert dropped[Reason.QueueFull] + dropped[Reason.TimedOut] == 300
    assert 0 < dropped[Reason.TimedOut] <= 300


def test_waiting_takes_one_thread_at_most(buffer):
    before = threading.active_count()
    kept = Kept(buffer, queue_size=0, buffer_timeout=Duration(seconds=1000))
    for _ in range(100):
        kept.filter.add(point(1))
    assert threading.active_count() <= before + 1
    kept.filter.destroy()


# The end


def test_clear_forgets_those_that_wait(buffer, insert, node, executor):
    kept = Kept(buffer, node=node)
    insert(1)
    kept.filter.add(point(1))
    kept.filter.add(point(0.5))
    kept.filter.add(point(2))
    kept.filter.clear()
    insert(2)
    until(lambda: kept.dropped, lambda: executor.spin_once(timeout_sec=1))
    executor.spin_once(timeout_sec=0)
    assert kept.passed == []
    assert kept.filter.statistics == (3, 0, {**dict.fromkeys(Reason, 0), Reason.OutTheBack: 1}, 2, 0)
    kept.filter.add(point(2))
    until(lambda: kept.passed, lambda: executor.spin_once(timeout_sec=1))


def test_destroyed_with_messages_that_wait(buffer, insert, node, executor):
    kept = Kept(buffer, node=node, buffer_timeout=Duration(seconds=0.01))
    kept.filter.add(point(1))
    kept.filter.destroy()
    kept.filter.destroy()
    insert(1)
    kept.filter.add(point(1))
    executor.spin_once(timeout_sec=0)
    assert (kept.passed, kept.dropped) == ([], [])
    assert kept.filter.statistics == (1, 0, dict.fromkeys(Reason, 0), 1, 0)


def test_the_buffer_waits_for_nobody_who_is_gone():
    buffer = OwnWaits()
    kept = Kept(buffer, queue_size=1)
    kept.filter.add(point(1))
    kept.filter.add(point(2))
    kept.filter.set_target_frame("map")
    kept.filter.clear()
    assert [future.cancelled() for future in buffer.futures] == [True] * 3
    begin_to_wait = buffer.wait_for_transform_async

    def meanwhile(*query, timeout=None):
        kept.filter.clear()
        return begin_to_wait(*query, timeout=timeout)

    buffer.wait_for_transform_async = meanwhile
    kept.filter.add(point(3))
    assert buffer.futures[3].cancelled()


def test_a_node_may_end_first(buffer, insert, node):
    kept = Kept(buffer, node=node, source=(PointStamped, "points", 10))
    kept.filter.add(point(1))
    node.destroy_node()
    insert(1)
    kept.filter.destroy()
    assert kept.passed == []


def test_the_buffer_may_be_cleared(buffer, insert):
    kept = Kept(buffer)
    insert(1)
    kept.filter.add(point(2))
    buffer.clear()
    kept.filter.add(point(3))
    assert kept.dropped == []
    insert(2)
    insert(3)
    assert kept.stamps == [2, 3]


class Message:
    """A message that can be watched."""

    def __init__(self, seconds, frame="laser"):
        self.header = point(seconds, frame).header


def test_messages_are_freed(buffer, insert):
    kept = MessageFilter(None, buffer, "base", 2)
    alive = weakref.WeakSet()

    def add(*messages):
        for message in messages:
            alive.add(message)
            kept.add(message)

    insert(1)
    add(Message(1), Message(0.5), Message(1, ""), Message(2), Message(3), Message(4))
    gc.collect()
    assert {message.header.stamp.sec for message in alive} == {3, 4}
    insert(3)
    gc.collect()
    assert {message.header.stamp.sec for message in alive} == {4}
    kept.clear()
    gc.collect()
    assert len(alive) == 0


def test_a_filter_that_nobody_keeps_is_freed_with_its_messages(buffer, insert):
    kept, message = MessageFilter(None, buffer, "base", 10), Message(1)
    passed = []
    kept.registerCallback(passed.append)
    kept.add(message)
    gone = weakref.ref(kept), weakref.ref(message)
    del kept, message
    gc.collect()
    assert [reference() for reference in gone] == [None, None]
    insert(1)
    assert passed == []


# Mistakes


def test_messages_without_a_header(buffer, node):
    kept = Kept(buffer)
    with pytest.raises(TypeError, match=r"Point has no header with a frame_id and a stamp.* PointStamped"):
        kept.filter.add(Point())
    with pytest.raises(TypeError, match="Point has no header"):
        MessageFilter((Point, "points", 10), buffer, "base", 10, node)
    with pytest.raises(TypeError, match=r"header.frame_id must be str, not NoneType"):
        kept.filter.add(SimpleNamespace(header=SimpleNamespace(frame_id=None, stamp=Time())))
    with pytest.raises(TypeError, match="time must have sec and nanosec, or nanoseconds"):
        kept.filter.add(SimpleNamespace(header=SimpleNamespace(frame_id="a", stamp=1.5)))
    assert kept.filter.statistics.received == 0


@pytest.mark.parametrize(
    ("arguments", "options", "error"),
    [
        (((PointStamped, "points", 10), "base", 10), {}, "the subscription to 'points' needs a node"),
        ((PointStamped, "base", 10), {}, "subscriber must be"),
        ((None, "base", 10.0), {}, "queue_size must be an int, not float"),
        ((None, 7, 10), {}, "not iterable"),
        ((None, [7], 10), {}, "a target frame must be str, not int"),
        ((None, "base", 10), {"buffer_timeout": 0.1}, r"buffer_timeout must be an rclpy Duration, not float"),
        ((None, "base", 10), {"callback_group": object()}, "a callback group is of use to a node only"),
    ],
)
def test_wrong_arguments(buffer, arguments, options, error):
    subscriber, *others = arguments
    with pytest.raises(TypeError, match=error):
        MessageFilter(subscriber, buffer, *others, **options)


def test_wrong_values(buffer):
    with pytest.raises(ValueError, match="at least one target frame"):
        MessageFilter(None, buffer, [], 10)
    with pytest.raises(ValueError, match="queue_size must not be negative, but is -1"):
        MessageFilter(None, buffer, "base", -1)
    kept = Kept(buffer)
    with pytest.raises(TypeError, match="the callback must be a function, not None"):
        kept.filter.registerCallback(None)
    with pytest.raises(TypeError, match="a coroutine function needs a node"):
        kept.filter.registerCallback(asyncio.sleep)
    with pytest.raises(TypeError, match="tolerance must be an rclpy Duration, not int"):
        kept.filter.set_tolerance(1)
