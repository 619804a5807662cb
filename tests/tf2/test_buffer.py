# SPDX-License-Identifier: Apache-2.0
"""tf2_ros.Buffer without a graph: timeouts, futures and transform()."""

import gc
import threading
import time

import pytest

import tf2_geometry_msgs  # noqa: F401 - registers the geometry messages
import tf2_ros
from coframe import _core
from geometry_msgs.msg import PointStamped, Pose, PoseStamped
from rclpy.duration import Duration
from rclpy.time import Time


def insert_later(buffer, message, started):
    """Return a function that inserts in a thread once the main thread waits."""

    def insert():
        started.wait()
        buffer.set_transform(message, "later")

    thread = threading.Thread(target=insert)
    thread.start()
    return thread


@pytest.fixture
def buffer():
    return tf2_ros.Buffer()


def test_lookup_and_can_transform(buffer, stamped):
    buffer.set_transform(stamped("a", "b", 1.0, (1.0, 2.0, 3.0)), "me")
    assert buffer.lookup_transform("a", "b", Time()).transform.translation.z == 3.0
    assert buffer.can_transform("a", "b", Time()) == 1
    assert type(buffer.can_transform("a", "b", Time())) is int
    assert buffer.can_transform("a", "b", Time(), return_debug_tuple=True) == (1, "")
    assert buffer.can_transform_full("a", Time(), "b", Time(), "a") == 1
    assert buffer.lookup_transform_full("a", Time(), "b", Time(), "a").child_frame_id == "b"
    assert isinstance(buffer, tf2_ros.BufferCore)
    assert isinstance(buffer, tf2_ros.BufferInterface)


def test_cache_time_as_keyword(stamped):
    buffer = tf2_ros.Buffer(cache_time=Duration(seconds=1))
    for seconds in (10.0, 12.0, 14.0):
        buffer.set_transform(stamped("a", "b", seconds), "me")
    assert not buffer.can_transform("a", "b", Time(seconds=10))


def test_lookup_waits_until_the_transform_is_available(buffer, stamped):
    started = threading.Event()
    thread = insert_later(buffer, stamped("a", "b", 1.0), started)
    begin = time.monotonic()
    started.set()
    assert buffer.lookup_transform("a", "b", Time(seconds=1), timeout=Duration(seconds=30)).child_frame_id == "b"
    assert time.monotonic() - begin < 10.0
    thread.join()


def test_can_transform_waits_as_well(buffer, stamped):
    started = threading.Event()
    thread = insert_later(buffer, stamped("a", "b", 1.0), started)
    started.set()
    assert buffer.can_transform("a", "b", Time(seconds=1), Duration(seconds=30)) == 1
    thread.join()


def test_lookup_describes_what_is_missing_after_a_timeout(buffer):
    begin = time.monotonic()
    with pytest.raises(tf2_ros.LookupException, match='"a" passed to lookupTransform argument target_frame'):
        buffer.lookup_transform("a", "b", Time(), timeout=Duration(seconds=0.05))
    assert time.monotonic() - begin >= 0.05
    answer = buffer.can_transform_full("a", Time(), "b", Time(), "c", Duration(seconds=0.01), return_debug_tuple=True)
    assert answer[0] == 0
    assert "frame does not exist" in answer[1]


def test_float_timeout_is_rejected(buffer):
    with pytest.raises(TypeError):
        buffer.lookup_transform("a", "b", Time(), timeout=0.1)


def test_coroutine_continues_after_set_transform(buffer, stamped):
    coroutine = buffer.lookup_transform_async("a", "b", Time(seconds=1))
    coroutine.send(None)
    buffer.set_transform(stamped("a", "b", 1.0, (7.0, 0.0, 0.0)), "me")
    with pytest.raises(StopIteration) as stop:
        coroutine.send(None)
    assert stop.value.value.transform.translation.x == 7.0


def test_full_coroutine_continues_after_set_transform_static(buffer, stamped):
    coroutine = buffer.lookup_transform_full_async("a", Time(), "b", Time(), "a")
    coroutine.send(None)
    buffer.set_transform_static(stamped("a", "b"), "me")
    with pytest.raises(StopIteration) as stop:
        coroutine.send(None)
    assert stop.value.value.header.frame_id == "a"


def test_future_completes_in_the_inserting_thread(buffer, stamped):
    future = buffer.wait_for_transform_async("a", "b", Time(seconds=1))
    threads = []
    future.add_done_callback(lambda _: threads.append(threading.current_thread()))
    buffer.set_transform(stamped("a", "c", 1.0), "me")
    assert not future.done()
    buffer.set_transform(stamped("a", "b", 1.0), "me")
    assert future.done()
    assert threads == [threading.current_thread()]
    assert future.result().child_frame_id == "b"


def test_future_of_an_available_transform_is_done(buffer, stamped):
    buffer.set_transform(stamped("a", "b", 1.0), "me")
    assert buffer.wait_for_transform_async("a", "b", Time()).result().child_frame_id == "b"
    assert buffer.wait_for_transform_full_async("a", Time(), "b", Time(), "a").done()


def test_future_completes_when_data_are_inserted_natively(buffer):
    future = buffer.wait_for_transform_async("a", "b", Time(seconds=1))
    done = _core.Event()
    future.add_done_callback(lambda _: done.set())
    # Insert without Python code, like a native subscription.
    buffer._Coframe__buffer._set_values("a", "b", 1_000_000_000, *(0.0,) * 6, 1.0, False, "wire")
    assert done.wait(10_000_000_000)
    assert future.result().header.frame_id == "a"


def test_async_timeout_raises_the_exception_of_the_lookup(buffer):
    future = buffer.wait_for_transform_async("a", "b", Time(), timeout=Duration(seconds=0.02))
    done = _core.Event()
    future.add_done_callback(lambda _: done.set())
    assert done.wait(10_000_000_000)
    with pytest.raises(tf2_ros.LookupException):
        future.result()


def test_cancelled_futures_are_removed(buffer, stamped):
    future = buffer.wait_for_transform_async("a", "b", Time())
    future.cancel()
    buffer.set_transform(stamped("a", "b", 1.0), "me")
    assert not future.done()
    assert buffer._Coframe__buffer._dispatcher.is_idle


def test_dispatcher_thread_ends_after_the_last_wait(buffer, stamped):
    before = set(threading.enumerate())
    buffer.wait_for_transform_async("a", "b", Time())
    (watcher,) = set(threading.enumerate()) - before
    assert watcher.daemon
    buffer.set_transform(stamped("a", "b", 1.0), "me")
    watcher.join(10.0)
    assert not watcher.is_alive()


def test_thread_ends_when_the_buffer_is_deleted():
    before = set(threading.enumerate())
    buffer = tf2_ros.Buffer()
    buffer.wait_for_transform_async("a", "b", Time())
    (watcher,) = set(threading.enumerate()) - before
    del buffer
    deadline = time.monotonic() + 10.0
    while watcher.is_alive() and time.monotonic() < deadline:
        gc.collect()
        watcher.join(0.01)
    assert not watcher.is_alive()


def test_backward_time_jump_clears_the_buffer(buffer, stamped):
    buffer.set_transform(stamped("a", "b", 1.0), "me")
    buffer.time_jump_callback(None)
    assert not buffer.can_transform("a", "b", Time())


def test_transform_of_stamped_data(buffer, stamped):
    buffer.set_transform(stamped("a", "b", 1.0, (1.0, 0.0, 0.0)), "me")
    buffer.set_transform(stamped("a", "b", 2.0, (2.0, 0.0, 0.0)), "me")
    point = PointStamped()
    point.header.frame_id = "b"
    point.header.stamp.sec = 1
    point.point.y = 5.0
    moved = buffer.transform(point, "a")
    assert (moved.point.x, moved.point.y) == (1.0, 5.0)
    assert moved.header.frame_id == "a"
    traveled = buffer.transform_full(point, "b", Time(seconds=2), "a")
    assert traveled.point.x == -1.0
    assert buffer.transform(point, "a", new_type=PointStamped) == moved


def test_unregistered_type(buffer):
    with pytest.raises(tf2_ros.TypeException) as caught:
        buffer.transform(Pose(), "a")
    assert caught.value.errstr == f"Type {Pose} is not loaded or supported"


def test_convert():
    pose = PoseStamped()
    copy = tf2_ros.convert(pose, PoseStamped)
    assert copy == pose
    assert copy is not pose

    class Mine:
        pass

    with pytest.raises(tf2_ros.TypeException):
        tf2_ros.convert(pose, Mine)
    tf2_ros.ConvertRegistration().add_from_msg(Mine, lambda _: Mine())
    assert isinstance(tf2_ros.convert(pose, Mine), Mine)
    tf2_ros.ConvertRegistration().add_convert((Mine, int), lambda _: 3)
    assert tf2_ros.convert(Mine(), int) == 3


def test_buffer_interface_implements_no_lookup():
    with pytest.raises(tf2_ros.NotImplementedException):
        tf2_ros.BufferInterface().lookup_transform("a", "b", Time())


def test_stamped():
    point = PointStamped()
    assert tf2_ros.Stamped(point, Time(seconds=3).to_msg(), "a") is point
    assert (point.header.frame_id, point.header.stamp.sec) == ("a", 3)


def test_numbers_as_times_are_rejected_with_a_hint():
    buffer = tf2_ros.Buffer()
    with pytest.raises(TypeError, match=r"timeout must be an rclpy Duration, not float. Use Duration\(seconds=0.5\)"):
        buffer.lookup_transform("a", "b", Time(), 0.5)
    with pytest.raises(TypeError, match=r"timeout must be an rclpy Duration, not int"):
        buffer.wait_for_transform_async("a", "b", Time(), timeout=1)
    with pytest.raises(TypeError, match=r"Got int. Use rclpy's Time\(seconds=...\), or Time\(\) for the latest"):
        buffer.lookup_transform("a", "b", 0)
