# SPDX-License-Identifier: Apache-2.0
"""message_filters: caches and synchronization, compared with a plain statement of the rule."""

import inspect
import itertools
import time
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import message_filters
import rclpy
import tf2_ros
from geometry_msgs.msg import PointStamped, TransformStamped
from message_filters import ApproximateTimeSynchronizer, Cache, SimpleFilter, Subscriber, TimeSynchronizer
from message_filters._matching import first_match
from rclpy.clock import ClockType
from rclpy.duration import Duration
from rclpy.time import Time
from std_msgs.msg import Header, String


def stamped(nanoseconds, name=""):
    header = Header(frame_id=name)
    header.stamp.sec, header.stamp.nanosec = divmod(nanoseconds, 1_000_000_000)
    return SimpleNamespace(header=header, time=nanoseconds, name=name)


def synchronize(kind, number, *args, **options):
    inputs = [SimpleFilter() for _ in range(number)]
    received = []
    synchronizer = kind(inputs, *args, **options)
    synchronizer.registerCallback(lambda *messages: received.append([m.time for m in messages]))
    return inputs, received, synchronizer


def expected_sets(arrivals, number, queue_size, slop):
    """Return the sets that the rule gives, by trying all combinations in order."""
    queues = [{} for _ in range(number)]
    sets = []
    for topic, stamp in arrivals:
        queue = queues[topic]
        queue[stamp] = True
        while len(queue) > queue_size:
            del queue[min(queue)]
        near = [
            [stamp]
            if other is queue
            else sorted((s for s in other if abs(s - stamp) <= slop), key=lambda s: abs(s - stamp))
            for other in queues
        ]
        for combination in itertools.product(*near):
            present = all(s in q for s, q in zip(combination, queues, strict=True))
            if present and max(combination) - min(combination) < slop:
                sets.append(list(combination))
                for s, q in zip(combination, queues, strict=True):
                    del q[s]
                break
    return sets


@settings(max_examples=150, deadline=None)
@given(st.integers(1, 4), st.integers(1, 5), st.integers(0, 12), st.data())
def test_approximate_sets_are_those_of_the_rule(number, queue_size, slop, data):
    arrival = st.tuples(st.integers(0, number - 1), st.integers(0, 30))
    arrivals = data.draw(st.lists(arrival, max_size=40))
    inputs, received, _ = synchronize(ApproximateTimeSynchronizer, number, queue_size, slop * 1e-9)
    for topic, stamp in arrivals:
        inputs[topic].signalMessage(stamped(stamp))
    assert received == expected_sets(arrivals, number, queue_size, slop)


def test_the_chosen_combination_is_the_first_of_all():
    random = np.random.default_rng(7)
    searched = 0
    for _ in range(3000):
        new, slop = 10, int(random.integers(0, 9))
        queues = [random.permutation(21)[: random.integers(1, 5)].tolist() for _ in range(random.integers(1, 4))]
        near = [sorted((s for s in q if abs(s - new) <= slop), key=lambda s: abs(s - new)) for q in queues]
        combinations = list(itertools.product(*near))
        valid = [list(c) for c in combinations if max(*c, new) - min(*c, new) < slop]
        assert first_match(new, queues, slop) == (valid[0] if valid else None)
        searched += bool(combinations) and list(combinations[0]) not in valid[:1]
    assert searched > 300, "often, the closest stamps do not fit together"


@settings(max_examples=80, deadline=None)
@given(st.integers(1, 4), st.integers(1, 5), st.data())
def test_exact_sets_have_equal_stamps(number, queue_size, data):
    arrivals = data.draw(st.lists(st.tuples(st.integers(0, number - 1), st.integers(0, 8)), max_size=40))
    inputs, received, _ = synchronize(TimeSynchronizer, number, queue_size)
    for topic, stamp in arrivals:
        inputs[topic].signalMessage(stamped(stamp))
    # Stamps that differ by less than one nanosecond are equal.
    assert received == expected_sets(arrivals, number, queue_size, slop=1)


def test_sets_whose_stamps_are_exactly_slop_apart_are_not_passed_on():
    inputs, received, _ = synchronize(ApproximateTimeSynchronizer, 2, 10, 0.1)
    inputs[0].signalMessage(stamped(0))
    inputs[1].signalMessage(stamped(100_000_000))
    assert received == []
    inputs[1].signalMessage(stamped(99_999_999))
    assert received == [[0, 99_999_999]]


def test_many_topics_take_little_time():
    # Each queue is full of close stamps that do not fit together: trying combinations would take 20**29 steps.
    number, queue_size = 30, 20
    inputs, received, _ = synchronize(ApproximateTimeSynchronizer, number, queue_size, 1e-6)
    for topic in range(number - 1):
        for stamp in range(queue_size):
            inputs[topic].signalMessage(stamped(10_000 + stamp + (900 if topic % 2 else -900)))
    start = time.process_time()
    for stamp in range(20):
        inputs[-1].signalMessage(stamped(10_000 + stamp))
    assert received == []
    assert time.process_time() - start < 1.0


def test_messages_without_header():
    inputs, received, _ = synchronize(ApproximateTimeSynchronizer, 2, 10, 0.5)
    for each in inputs:
        each.signalMessage(SimpleNamespace(time=1))
    assert received == []
    inputs, received, _ = synchronize(ApproximateTimeSynchronizer, 2, 10, 0.5, allow_headerless=True)
    for each in inputs:
        each.signalMessage(SimpleNamespace(time=1))
    assert received == [[1, 1]]
    inputs, _, _ = synchronize(TimeSynchronizer, 1, 10)
    with pytest.raises(AttributeError):
        inputs[0].signalMessage(String())


def test_arrival_time_replaces_the_stamps():
    inputs, received, _ = synchronize(ApproximateTimeSynchronizer, 2, 10, 0.5, sync_arrival_time=True)
    inputs[0].signalMessage(stamped(0))
    inputs[1].signalMessage(stamped(10**12))
    assert received == [[0, 10**12]]


def test_a_jump_back_of_the_clock_drops_waiting_messages():
    clock = SimpleNamespace(time=100)
    node = SimpleNamespace(get_clock=lambda: SimpleNamespace(now=lambda: Time(nanoseconds=clock.time)))
    inputs = [SimpleFilter(), SimpleFilter()]
    inputs[0].node = node
    received = []
    TimeSynchronizer(inputs, 1).registerCallback(lambda *messages: received.append(messages[0].time))
    inputs[0].signalMessage(stamped(100))
    clock.time = 5  # The recording was started again.
    for each in inputs:
        each.signalMessage(stamped(5))
    assert received == [5], "a message of the future does not fill the queue"


def test_cache_keeps_the_last_messages():
    source, passed = SimpleFilter(), []
    cache = Cache(source, cache_size=3)
    cache.registerCallback(lambda message, extra: passed.append((message.time, extra)), "extra")
    assert (cache.getLast(), cache.getLastestTime(), cache.getLatestTime(), cache.getOldestTime()) == (None,) * 4
    for stamp in (10, 20, 30, 40):
        source.signalMessage(stamped(stamp))
    at = {n: Time(nanoseconds=n, clock_type=ClockType.ROS_TIME) for n in range(0, 70, 5)}
    assert [m.time for m in cache.getInterval(at[20], at[30])] == [20, 30]
    assert [m.time for m in cache.getInterval(at[0], at[65])] == [20, 30, 40]
    assert cache.getElemAfterTime(at[20]).time == 20
    assert cache.getElemAfterTime(at[25]).time == 30
    assert cache.getElemAfterTime(at[45]) is None
    assert cache.getElemBeforeTime(at[35]).time == 30
    assert cache.getElemBeforeTime(at[15]) is None
    assert (cache.getOldestTime(), cache.getLastestTime(), cache.getLast().time) == (at[20], at[40], 40)
    assert passed == [(10, "extra"), (20, "extra"), (30, "extra"), (40, "extra")]
    with pytest.raises(AssertionError):
        cache.getInterval(at[30], at[20])
    source.signalMessage(String())
    assert cache.getLast().time == 40, "messages without a header are ignored"
    headerless = Cache(source, 1, allow_headerless=True)
    source.signalMessage(String(data="a"))
    assert headerless.getLast().data == "a"


def test_topics_are_synchronized(node, make_node, wait_until):
    talker = make_node("talker")
    publishers = [talker.create_publisher(PointStamped, name, 10) for name in ("left", "right")]
    subscribers = [Subscriber(node, PointStamped, name, qos_profile=10) for name in ("left", "right")]
    assert subscribers[0].getTopic() == subscribers[0].topic == "left"
    assert subscribers[0].topic_name == "/left"
    with pytest.raises(AttributeError):
        subscribers[0].missing  # noqa: B018 - the access is what is tested
    received = []
    synchronizer = ApproximateTimeSynchronizer(subscribers, 10, slop=0.05)
    assert synchronizer.slop == Duration(seconds=0.05)
    synchronizer.registerCallback(lambda left, right: received.append((left.point.x, right.point.x)))
    wait_until(lambda: all(p.get_subscription_count() for p in publishers))
    for number in range(3):
        for publisher, late in zip(publishers, (0, 20_000_000), strict=True):
            message = PointStamped(header=stamped(10**9 * (number + 1) + late).header)
            message.point.x = float(number)
            publisher.publish(message)
    executor = rclpy.executors.SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    wait_until(lambda: len(received) == 3, meanwhile=lambda: executor.spin_once(timeout_sec=0.1))
    assert received == [(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)]


def test_filters_of_tf2_are_inputs():
    buffer = tf2_ros.Buffer()
    images, scans = SimpleFilter(), SimpleFilter()
    in_base = tf2_ros.MessageFilter(images, buffer, "base", 10)
    received = []
    TimeSynchronizer([in_base, scans], 10).registerCallback(lambda *pair: received.append([m.name for m in pair]))
    for each in (images, scans):
        each.signalMessage(stamped(10**9, "camera"))
    assert received == []
    transform = TransformStamped(header=Header(frame_id="base"), child_frame_id="camera")
    buffer.set_transform_static(transform, "test")
    assert received == [["camera", "camera"]]


def test_signatures_are_upstreams():
    def names(function):
        return list(inspect.signature(function).parameters)

    assert set(message_filters.__all__) >= {
        "ApproximateTimeSynchronizer", "Cache", "SimpleFilter", "Subscriber", "TimeSynchronizer",
    }  # fmt: skip
    assert names(TimeSynchronizer) == ["fs", "queue_size"]
    arguments = ["fs", "queue_size", "slop", "allow_headerless", "sync_arrival_time", "offsets"]
    assert names(ApproximateTimeSynchronizer) == arguments
    assert names(Cache) == ["f", "cache_size", "allow_headerless"]
    assert names(TimeSynchronizer.add) == ["self", "msg", "my_queue", "my_queue_index"]


def test_a_sequencer_sorts_messages_and_delays_them(context_node):
    node, spin = context_node
    received = []
    source = SimpleFilter()
    sequencer = message_filters.TimeSequencer(source, 0.2, Duration(seconds=0.01), 10, node)
    sequencer.registerCallback(lambda message: received.append((message.name, node.get_clock().now().nanoseconds)))
    start = node.get_clock().now().nanoseconds
    for name, offset in (("b", 20), ("a", 10), ("c", 30)):
        source.signalMessage(stamped(start + offset * 1_000_000, name))
    spin(lambda: len(received) == 3)
    assert [name for name, _ in received] == ["a", "b", "c"]
    assert all(at >= start + 210_000_000 for _, at in received)
    source.signalMessage(stamped(start, "late"))
    source.signalMessage(stamped(start + 40_000_000, "d"))
    spin(lambda: len(received) == 4)
    assert received[3][0] == "d"


def test_a_sequencer_drops_the_earliest_messages_of_a_full_queue(context_node):
    node, spin = context_node
    received = []
    sequencer = message_filters.TimeSequencer(None, 0.05, 0.01, 2, node)
    sequencer.registerCallback(lambda message: received.append(message.name))
    start = node.get_clock().now().nanoseconds
    for number, name in enumerate("abc"):
        sequencer.add(stamped(start + number, name))
    spin(lambda: len(received) == 2)
    assert received == ["b", "c"]


@pytest.fixture
def context_node(domain_id):
    context = rclpy.context.Context()
    context.init([], domain_id=domain_id)
    node = rclpy.create_node("filters", context=context)
    executor = rclpy.executors.SingleThreadedExecutor(context=context)
    executor.add_node(node)

    def spin(condition):
        deadline = time.monotonic() + 10
        while not condition():
            assert time.monotonic() < deadline
            executor.spin_once(timeout_sec=0.1)

    yield node, spin
    executor.shutdown()
    node.destroy_node()
    context.try_shutdown()


def test_offsets_are_added_before_stamps_are_compared():
    inputs, received, _ = synchronize(ApproximateTimeSynchronizer, 2, 5, 0.01, offsets=[Duration(seconds=1), 0.0])
    inputs[0].signalMessage(stamped(0))
    inputs[1].signalMessage(stamped(0))
    assert received == []
    inputs[1].signalMessage(stamped(1_000_000_000))
    assert received == [[0, 1_000_000_000]]
    with pytest.raises(ValueError, match="1 offsets for 2 filters"):
        synchronize(ApproximateTimeSynchronizer, 2, 5, 0.01, offsets=[0.0])


def test_a_chain_passes_messages_through_all_filters():
    source, received = SimpleFilter(), []
    chain = message_filters.Chain(message_filters.ComparisonFilter(source, lambda last, new: new.time != last.time))
    chain.registerCallback(lambda message, word: received.append((message.name, word)), "word")
    cache = Cache(None, 5)
    assert chain.addFilter(cache) == 1
    for time_, name in ((1, "a"), (1, "b"), (2, "c")):
        source.signalMessage(stamped(time_, name))
    assert received == [("a", "word"), ("c", "word")]
    assert [message.name for message in cache.cache_msgs] == ["a", "c"]
    assert (chain.getFilter(1), chain.getFilter(2)) == (cache, None)
    chain.add(stamped(3, "d"))
    assert received[-1] == ("d", "word")


def test_delta_filters_let_changes_through():
    received, by_function = [], []
    delta = message_filters.DeltaFilter(None, "twist.linear.x", 0.5)
    delta.registerCallback(lambda message: received.append(message.twist.linear.x))
    other = message_filters.DeltaFilter(delta, lambda message: message.twist.linear.x, 2.0)
    other.registerCallback(lambda message: by_function.append(message.twist.linear.x))
    for x in (0.0, 0.4, 0.5, 0.9, -3.0):
        delta.add(SimpleNamespace(twist=SimpleNamespace(linear=SimpleNamespace(x=x))))
    assert received == [0.0, 0.5, -3.0]
    assert by_function == [0.0, -3.0]


def test_path_filters_measure_the_way():
    received = []
    path = message_filters.PathDeltaFilter(None, "point", 2.0)
    path.registerCallback(lambda message: received.append(message.point.x))
    for x in (0.0, 1.0, 0.0, 0.5, 2.0, 2.5):
        message = PointStamped()
        message.point.x = x
        path.add(message)
    assert received == [0.0, 0.0, 2.0]
    pairs = message_filters.PathDeltaFilter(None, lambda message: (message, 0.0), 1.0)
    pairs.registerCallback(received.append)
    pairs.add(7.0)
    assert received[-1] == 7.0


def test_an_aligner_passes_messages_on_in_the_order_of_their_stamps():
    first, second, received = SimpleFilter(), SimpleFilter(), []
    aligner = message_filters.InputAligner(Duration(seconds=1e-6), first, second)
    for index in (0, 1):
        aligner.registerCallback(index, lambda message, index: received.append((index, message.time)), index)
        aligner.setInputPeriod(index, Duration(nanoseconds=10))
    first.signalMessage(stamped(10))
    second.signalMessage(stamped(5))
    assert received == [(1, 5), (0, 10)]
    first.signalMessage(stamped(20))  # The second filter can still deliver 15.
    assert received == [(1, 5), (0, 10)]
    second.signalMessage(stamped(15))
    assert received[2:] == [(1, 15), (0, 20)]
    second.signalMessage(stamped(7))  # earlier than one that was passed on
    first.signalMessage(stamped(2_000))
    first.signalMessage(stamped(4_000))
    assert received[4:] == [(0, 2_000)]
