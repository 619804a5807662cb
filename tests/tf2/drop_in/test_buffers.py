# SPDX-License-Identifier: Apache-2.0
"""Buffers without a graph, tested through upstream's names only, like upstream's own tests."""

import copy
import os
import pickle
import subprocess
import sys

import pytest

import tf2_geometry_msgs  # noqa: F401 - registers the geometry messages
import tf2_py
import tf2_ros
from builtin_interfaces.msg import Time as TimeMessage
from geometry_msgs.msg import (
    PointStamped,
    PolygonStamped,
    PoseStamped,
    PoseWithCovarianceStamped,
    TransformStamped,
    Vector3Stamped,
)
from rclpy.duration import Duration
from rclpy.time import Time


@pytest.fixture
def buffer(stamped):
    """Return a buffer with foo -> bar, at x = 3 m at 1 s and 4 m at 2 s, and the static bar -> sensor."""
    buffer = tf2_ros.Buffer()
    buffer.set_transform(stamped("foo", "bar", 1.0, (3.0, 0.0, 0.0)), "unittest")
    buffer.set_transform(stamped("foo", "bar", 2.0, (4.0, 0.0, 0.0)), "unittest")
    buffer.set_transform_static(stamped("bar", "sensor", 0.0, (0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 0.0)), "unittest")
    return buffer


def resumed(coroutine):
    """Return the result of a coroutine that does not need to wait."""
    with pytest.raises(StopIteration) as stop:
        coroutine.send(None)
    return stop.value.value


def test_buffer_requires_no_init():
    """Run in a separate process, because other tests have called rclpy.init()."""
    code = """
import tf2_ros
from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.time import Time
buffer = tf2_ros.Buffer(Duration(seconds=1))
transform = TransformStamped(child_frame_id="bar")
transform.header.frame_id = "foo"
buffer.set_transform(transform, "me")
print(buffer.can_transform("foo", "bar", Time(), timeout=Duration(seconds=1)))
print(buffer.wait_for_transform_async("foo", "bar", Time()).result().child_frame_id)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["1", "bar"]


def test_can_transform_returns_numbers(buffer):
    for answer in (
        buffer.can_transform("foo", "bar", Time(seconds=1)),
        buffer.can_transform_full("foo", Time(seconds=1), "bar", Time(seconds=2), "foo"),
    ):
        assert type(answer) is int
        assert answer == 1
    answer, reason = buffer.can_transform("foo", "baz", Time(), Duration(), True)
    assert (type(answer), answer) == (int, 0)
    assert reason == 'Invalid frame ID "baz" passed to canTransform argument source_frame - frame does not exist'


def test_keyword_arguments(buffer):
    found = buffer.lookup_transform(target_frame="foo", source_frame="bar", time=Time(seconds=1), timeout=Duration())
    assert found.transform.translation.x == 3.0
    found = buffer.lookup_transform_full(
        target_frame="bar",
        target_time=Time(seconds=1),
        source_frame="bar",
        source_time=Time(seconds=2),
        fixed_frame="foo",
    )
    assert found.transform.translation.x == 1.0
    assert (found.header.frame_id, found.child_frame_id, found.header.stamp.sec) == ("bar", "bar", 1)


@pytest.mark.parametrize("time", [Time(seconds=1), TimeMessage(sec=1), Duration(seconds=1)])
def test_time_types(buffer, time):
    assert buffer.lookup_transform("foo", "bar", time).transform.translation.x == 3.0
    assert buffer.can_transform("foo", "bar", time) == 1


def test_coroutines_run_by_send(stamped):
    buffer = tf2_ros.Buffer()
    coroutine = buffer.lookup_transform_async("foo", "bar", Time(seconds=1))
    coroutine.send(None)
    buffer.set_transform(stamped("foo", "bar", 1.0, (42.0, -3.14, 0.0)), "unittest")
    assert resumed(coroutine).transform.translation.x == 42.0

    coroutine = buffer.lookup_transform_full_async("foo", Time(seconds=1), "baz", Time(seconds=1), "foo")
    coroutine.send(None)
    buffer.set_transform_static(stamped("bar", "baz"), "unittest")
    found = resumed(coroutine)
    assert (found.header.frame_id, found.child_frame_id) == ("foo", "baz")


def test_coroutine_of_an_available_transform_does_not_wait(buffer):
    assert resumed(buffer.lookup_transform_async("foo", "bar", Time(seconds=1))).transform.translation.x == 3.0


def test_futures_of_waits(stamped):
    buffer = tf2_ros.Buffer()
    futures = [
        buffer.wait_for_transform_async("foo", "bar", Time(seconds=1)),
        buffer.wait_for_transform_full_async("foo", Time(seconds=1), "bar", Time(seconds=1), "foo"),
    ]
    buffer.set_transform(stamped("foo", "other", 1.0), "unittest")
    assert not any(future.done() for future in futures)
    buffer.set_transform(stamped("foo", "bar", 1.0), "unittest")
    assert all(future.done() and future.result() for future in futures)


@pytest.mark.parametrize(
    ("target", "source", "seconds", "kind"),
    [
        ("foo", "nowhere", 1, "LookupException"),
        ("foo", "island", 1, "ConnectivityException"),
        ("foo", "bar", 9, "ExtrapolationException"),
        ("", "bar", 1, "InvalidArgumentException"),
    ],
)
def test_failed_lookups(buffer, stamped, target, source, seconds, kind):
    buffer.set_transform(stamped("sea", "island", 1.0), "unittest")
    with pytest.raises(tf2_ros.TransformException) as caught:
        buffer.lookup_transform(target, source, Time(seconds=seconds))
    assert type(caught.value) is getattr(tf2_py, kind)
    assert caught.value.args == (str(caught.value),)
    assert repr(type(caught.value)) == f"<class 'tf2.{kind}'>"
    for copied in (copy.copy(caught.value), pickle.loads(pickle.dumps(caught.value))):
        assert (type(copied), copied.args) == (type(caught.value), caught.value.args)


def test_subclasses_of_exceptions_can_be_pickled():
    error = pickle.loads(pickle.dumps(tf2_ros.TimeoutException("too", "late")))
    assert type(error) is tf2_ros.TimeoutException
    error = tf2_ros.LookupException("first")
    error.args = ("second",)
    assert str(error) == "second"


def test_latest_common_time_before_the_epoch(stamped):
    core = tf2_py.BufferCore()
    core.set_transform(stamped("foo", "bar", -2.5), "unittest")
    latest = core.get_latest_common_time("foo", "bar")
    assert latest.nanoseconds == -2_500_000_000
    assert core.lookup_transform_core("foo", "bar", latest).header.stamp == latest.to_msg()
    assert latest.to_msg() == TimeMessage(sec=-3, nanosec=500_000_000)


def test_subclass_that_overrides_set_transform(stamped):
    class Upside(tf2_ros.Buffer):
        def set_transform(self, transform, authority):
            transform.transform.translation.z *= -1.0
            super().set_transform(transform, authority)

    buffer = Upside(cache_time=Duration(seconds=1), node=None)
    future = buffer.wait_for_transform_async("foo", "bar", Time())
    buffer.set_transform(stamped("foo", "bar", 1.0, (0.0, 0.0, 2.0)), "unittest")
    assert future.done()
    assert buffer.lookup_transform("foo", "bar", Time()).transform.translation.z == -2.0


def test_subclass_with_additional_attributes(stamped):
    class Mine(tf2_ros.Buffer):
        def __init__(self):
            super().__init__()
            self._buffer = self._core = self._lookup = self._lookup_full = self._insert = self._transform_futures = None

    buffer = Mine()
    future = buffer.wait_for_transform_async("foo", "bar", Time(seconds=1))
    buffer.set_transform(stamped("foo", "bar", 1.0), "unittest")
    assert future.done()
    assert buffer.lookup_transform("foo", "bar", Time(seconds=1)).child_frame_id == "bar"
    assert buffer.lookup_transform_full("foo", Time(), "bar", Time(), "foo").child_frame_id == "bar"
    assert buffer.can_transform("foo", "bar", Time(), Duration(seconds=1))


def test_subclass_that_overrides_lookup_transform(stamped):
    class Fixed(tf2_ros.BufferInterface):
        def lookup_transform(self, target_frame, source_frame, *_):
            return stamped(target_frame, source_frame, 1.0, (1.0, 0.0, 0.0))

    assert Fixed().transform(PointStamped(), "foo").point.x == 1.0
    with pytest.raises(tf2_ros.NotImplementedException) as caught:
        Fixed().can_transform("foo", "bar", Time())
    assert caught.value.errstr == "CanTransform or LookupTransform not implemented"


STAMPED = [PointStamped, Vector3Stamped, PoseStamped, PoseWithCovarianceStamped, PolygonStamped]


@pytest.mark.parametrize("kind", STAMPED)
def test_transform_of_stamped_data(buffer, kind):
    message = kind()
    message.header.frame_id, message.header.stamp.sec = "sensor", 1
    before = copy.deepcopy(message)
    moved = buffer.transform(message, "foo", new_type=kind)
    assert type(moved) is kind
    assert (moved.header.frame_id, moved.header.stamp.sec) == ("foo", 1)
    traveled = buffer.transform_full(message, "bar", Time(seconds=2), "foo", Duration())
    assert (traveled.header.frame_id, traveled.header.stamp.sec) == ("bar", 2)
    assert message == before


def test_transform_full_of_a_point(buffer):
    point = PointStamped()
    point.header.frame_id, point.header.stamp.sec = "sensor", 1
    point.point.x = 1.0
    moved = buffer.transform(point, "foo")
    assert [moved.point.x, moved.point.y, moved.point.z] == pytest.approx([2.0, 0.0, 1.0])
    # A point at x = 2 m in foo at 1 s is at x = -2 m in bar at 2 s.
    assert buffer.transform_full(point, "bar", Time(seconds=2), "foo").point.x == pytest.approx(-2.0)


def test_new_types(buffer):
    class Distance(float):
        """A distance in meters."""

    conversions = tf2_ros.ConvertRegistration()
    conversions.add_convert((PointStamped, Distance), lambda point: Distance(point.point.x))
    conversions.add_to_msg(Distance, lambda _: PointStamped())
    point = PointStamped()
    point.header.frame_id, point.header.stamp.sec = "bar", 1
    moved = buffer.transform(point, "foo", Duration(), Distance)
    assert (type(moved), moved) == (Distance, 3.0)
    assert type(tf2_ros.convert(Distance(), PointStamped)) is PointStamped


def test_registrations_are_shared():
    class Mine:
        pass

    tf2_ros.TransformRegistration().add(Mine, lambda data, _: data)
    assert tf2_ros.BufferInterface().registration.get(Mine)
    tf2_ros.ConvertRegistration().add_from_msg(Mine, lambda _: Mine())
    assert type(tf2_ros.ConvertRegistration().get_from_msg(Mine)(None)) is Mine


def test_registry_can_be_printed(capsys):
    tf2_ros.TransformRegistration().print_me()
    assert "PoseStamped" in capsys.readouterr().out


def test_unregistered_types(buffer):
    text = "Type <class 'geometry_msgs.msg.TransformStamped'> is not loaded or supported"
    with pytest.raises(tf2_ros.TypeException) as caught:
        buffer.transform(TransformStamped(), "foo")
    assert (str(caught.value), caught.value.errstr) == (text, text)
    # Upstream looks for the converter to a message first.
    with pytest.raises(tf2_ros.TypeException, match="<class 'int'> is not"):
        tf2_ros.convert(3, str)


def test_stamped_objects():
    class Thing:
        pass

    thing = tf2_ros.Stamped(Thing(), TimeMessage(sec=3), "foo")
    assert (thing.header.frame_id, thing.header.stamp.sec) == ("foo", 3)


def test_velocities(buffer):
    linear, angular = buffer.lookupVelocityCore("bar", "foo", Time(seconds=1.5), Duration(seconds=0.5))
    assert linear == pytest.approx((1.0, 0.0, 0.0))
    assert angular == (0.0, 0.0, 0.0)
    interval = Duration(seconds=0.5)
    full = buffer.lookupVelocityFullCore("bar", "foo", "foo", (0.0, 0.0, 0.0), "bar", Time(seconds=1.5), interval)
    assert full[0] == pytest.approx(linear)


def test_messages_without_type_checks():
    """Upstream's rolling tests assign an rclpy Time to a stamp and an int to a float field."""
    code = """
import tf2_ros
from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.time import Time
buffer = tf2_ros.Buffer()
for seconds in (1, 2):
    transform = TransformStamped(child_frame_id="bar")
    transform.header.frame_id = "foo"
    transform.header.stamp = Time(seconds=seconds)
    transform.transform.translation.x = 3 * seconds
    buffer.set_transform(transform, "unittest")
print(buffer.lookup_transform("foo", "bar", Time(seconds=1.5)).transform.translation.x)
print(buffer.lookupVelocityCore("bar", "foo", Time(seconds=1.5), Duration(seconds=1.0)))
"""
    done = subprocess.run(
        [sys.executable, "-c", code],
        env=os.environ | {"ROS_PYTHON_CHECK_FIELDS": "0"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.splitlines() == ["4.5", "((3.0, 0.0, 0.0), (0.0, 0.0, 0.0))"]
    with pytest.raises(AssertionError, match="The 'x' field must be of type 'float'"):
        TransformStamped().transform.translation.x = "3"
