# SPDX-License-Identifier: Apache-2.0
"""API of BufferCore: arguments, return types and texts. The results are tested with the core."""

import re
from types import SimpleNamespace

import pytest
import yaml

import rclpy.time
import tf2_py
from builtin_interfaces.msg import Time as TimeMessage
from coframe import CoframeError
from geometry_msgs.msg import Quaternion, TransformStamped, Vector3
from rclpy.clock import ClockType
from rclpy.duration import Duration
from rclpy.time import Time


@pytest.fixture
def core(stamped):
    """Return a buffer with a -> b, moving along x with 1 m/s from 10 to 12 s, static b -> c, and a separate d -> e."""
    core = tf2_py.BufferCore()
    for time in (10.0, 11.0, 12.0):
        core.set_transform(stamped("a", "b", time, (time, 0.0, 0.0)), "robot")
    core.set_transform_static(stamped("b", "c", 0.0, (0.0, 1.0, 0.0)), "robot")
    core.set_transform(stamped("d", "e", 10.0), "other")
    return core


def test_exception_classes():
    for name in ("Lookup", "Connectivity", "Extrapolation", "InvalidArgument", "Timeout"):
        exception = getattr(tf2_py, f"{name}Exception")
        assert exception.__bases__ == (tf2_py.TransformException,)
        assert str(exception("text")) == "text"
    assert tf2_py.TransformException.__mro__[1:3] == (CoframeError, Exception)


def test_lookup_returns_a_message(core):
    found = core.lookup_transform_core("a", "c", Time(seconds=11, nanoseconds=500_000_000))
    assert type(found) is TransformStamped
    assert (found.header.frame_id, found.child_frame_id) == ("a", "c")
    assert found.header.stamp == TimeMessage(sec=11, nanosec=500_000_000)
    assert found.transform.translation == Vector3(x=11.5, y=1.0, z=0.0)
    assert found.transform.rotation == Quaternion(w=1.0)


def test_time_zero_requests_the_latest(core):
    assert core.lookup_transform_core("a", "b", Time()).header.stamp.sec == 12
    assert core.lookup_transform_core("b", "c", Time()).header.stamp == TimeMessage()


@pytest.mark.parametrize(
    "time",
    [
        Time(seconds=11),
        TimeMessage(sec=11),
        Duration(seconds=11),
        SimpleNamespace(sec=11, nanosec=0),
        SimpleNamespace(nanoseconds=11_000_000_000),
    ],
)
def test_time_types(core, time):
    assert core.lookup_transform_core("a", "b", time).transform.translation.x == 11.0


def test_invalid_times_raise_the_error_of_tf2(core):
    with pytest.raises(TypeError, match=re.escape("time must have sec and nanosec, or nanoseconds.")):
        core.lookup_transform_core("a", "b", 11)
    with pytest.raises(TypeError, match=re.escape("duration must have sec and nanosec, or nanoseconds.")):
        tf2_py.BufferCore(10)


def test_frame_names_are_strings(core):
    with pytest.raises(TypeError, match=r"^argument 2 must be str, not int$"):
        core.lookup_transform_core("a", 1, Time())
    with pytest.raises(ValueError, match=r"^embedded null character$"):
        core.can_transform_core("a\0", "b", Time())
    with pytest.raises(TypeError, match=r"^argument 2 must be str, not int$"):
        core.set_transform(TransformStamped(), 1)


def test_frame_names_with_special_characters(core, stamped):
    core.set_transform(stamped("a", "räder/左", 10.0), "robot")
    assert core.lookup_transform_core("a", "räder/左", Time()).child_frame_id == "räder/左"


def test_keyword_and_positional_arguments(core):
    assert core.can_transform_core(target_frame="a", source_frame="b", time=Time()) == (1, "")
    assert core.lookup_transform_core(target_frame="a", source_frame="b", time=Time())
    full = {
        "target_frame": "a",
        "target_time": Time(),
        "source_frame": "b",
        "source_time": Time(),
        "fixed_frame": "a",
    }
    assert core.can_transform_full_core(**full) == (1, "")
    assert core.lookup_transform_full_core(**full)
    with pytest.raises(TypeError):
        core.set_transform(transform=TransformStamped(), authority="robot")
    with pytest.raises(TypeError):
        core.get_latest_common_time(target_frame="a", source_frame="b")


def test_cache_time_is_positional_and_keywords_are_ignored(stamped):
    for core, oldest_is_kept in ((tf2_py.BufferCore(Duration(seconds=1)), 0), (tf2_py.BufferCore(cache_time=1), 1)):
        for time in (10.0, 12.0, 14.0):
            core.set_transform(stamped("a", "b", time), "robot")
        assert core.can_transform_core("a", "b", Time(seconds=10))[0] == oldest_is_kept


def test_can_transform_returns_an_int_and_the_reason(core):
    answer, text = core.can_transform_core("a", "x", Time())
    assert type(answer) is int
    assert answer == 0
    assert text == 'Invalid frame ID "x" passed to canTransform argument source_frame - frame does not exist'


EXTRAPOLATION = (
    "Lookup would require extrapolation into the {}.  Requested time {} but the {} data is at time {}, "
    "when looking up transform from frame [b] to frame [a]"
)
INVALID = 'Invalid argument "{}" passed to lookupTransform argument target_frame - in tf2 frame_ids cannot {}'
UNCONNECTED = (
    "Could not find a connection between 'a' and 'e' because they are not part of the same tree."
    "Tf has two or more unconnected trees."
)


@pytest.mark.parametrize(
    ("target", "source", "seconds", "kind", "text"),
    [
        ("a", "x", 0, "Lookup", '"x" passed to lookupTransform argument source_frame does not exist. '),
        ("", "b", 0, "InvalidArgument", INVALID.format("", "be empty")),
        ("/a", "b", 0, "InvalidArgument", INVALID.format("/a", "start with a '/'")),
        ("a", "b", 13, "Extrapolation", EXTRAPOLATION.format("future", "13.000000", "latest", "12.000000")),
        ("a", "b", 9, "Extrapolation", EXTRAPOLATION.format("past", "9.000000", "earliest", "10.000000")),
        ("a", "e", 10, "Connectivity", UNCONNECTED),
    ],
)
def test_texts_of_failed_lookups(core, target, source, seconds, kind, text):
    with pytest.raises(getattr(tf2_py, f"{kind}Exception")) as caught:
        core.lookup_transform_core(target, source, Time(seconds=seconds))
    assert str(caught.value) == text


def test_latest_common_time_is_an_rclpy_time(core):
    latest = core.get_latest_common_time("a", "c")
    assert type(latest) is Time
    assert latest == Time(seconds=12, clock_type=ClockType.SYSTEM_TIME)
    with pytest.raises(tf2_py.TransformException, match="not part of the same tree"):
        core.get_latest_common_time("a", "e")


def test_full_lookup(core):
    found = core.lookup_transform_full_core("b", Time(seconds=10), "b", Time(seconds=12), "a")
    assert found.transform.translation.x == 2.0
    assert found.header.stamp.sec == 10
    assert core.can_transform_full_core("b", Time(seconds=10), "b", Time(seconds=13), "a")[0] == 0


def test_velocity(core):
    linear, angular = core.lookupVelocityCore("b", "a", Time(seconds=11), Duration(seconds=0.5))
    assert linear == pytest.approx((1.0, 0.0, 0.0))
    assert angular == (0.0, 0.0, 0.0)
    full = core.lookupVelocityFullCore("b", "a", "a", (0.0, 0.0, 0.0), "b", Time(seconds=11), Duration(seconds=0.5))
    assert full[0] == pytest.approx(linear)


def test_axis_of_the_angular_velocity(stamped):
    core = tf2_py.BufferCore()
    # A quarter turn about y in one second.
    core.set_transform(stamped("a", "b", 1.0), "robot")
    core.set_transform(stamped("a", "b", 2.0, rotation=(0.0, 0.5**0.5, 0.0, 0.5**0.5)), "robot")
    _, angular = core.lookupVelocityCore("b", "a", Time(seconds=1.5), Duration(seconds=0.5))
    assert angular == pytest.approx((0.0, 1.5707963267948966, 0.0))


def test_velocity_of_an_unknown_frame(core):
    with pytest.raises(tf2_py.LookupException, match='"x" passed to lookupTransform'):
        core.lookupVelocityCore("x", "a", Time(seconds=11), Duration(seconds=0.5))


def test_frame_names(core):
    assert core._getFrameStrings() == ["b", "a", "c", "e", "d"]
    assert core._frameExists("a")
    assert not core._frameExists("x")
    assert core._frameExists("NO_PARENT")


def test_chain(core, stamped):
    core.set_transform(stamped("w", "r", 1.0), "robot")
    core.set_transform(stamped("w", "r", 2.0), "robot")
    assert core._chain("r", Time(seconds=1), "r", Time(seconds=2), "w") == ["r", "w", "r"]


def test_text_descriptions_of_all_frames(core):
    frames = yaml.safe_load(core.all_frames_as_yaml())
    assert frames["b"]["parent"] == "a"
    assert frames["b"]["broadcaster"] == "robot"
    assert frames["c"]["rate"] == 10000.0
    assert "Frame c exists with parent b.\n" in core.all_frames_as_string()
    assert core._allFramesAsDot().startswith("digraph G {\n")
    assert "Recorded at time: 14.000000" in core._allFramesAsDot(time=Time(seconds=14))
    assert tf2_py.BufferCore().all_frames_as_yaml() == "[]"


def test_clear_keeps_frames_and_static_transforms(core):
    core.clear()
    assert core._frameExists("b")
    assert core.can_transform_core("b", "c", Time()) == (1, "")
    assert core.can_transform_core("a", "b", Time())[0] == 0


def test_rejected_data_are_reported_on_stderr(core, stamped, capfd):
    assert core.set_transform(stamped("a", "a", 1.0), "me") is None
    assert capfd.readouterr().err == (
        'Error:   TF_SELF_TRANSFORM: Ignoring transform from authority "me" with frame_id and  child_frame_id "a" '
        "because they are the same\n"
    )
    core.set_transform(stamped("a", "z", 1.0, rotation=(0.0, 0.0, 0.0, 0.0)), "me")
    first, second = capfd.readouterr().err.splitlines()
    assert first.startswith('Error:   TF_NAN_INPUT: Ignoring transform for child_frame_id "z" from authority "me"')
    assert second.startswith("Error:   TF_DENORMALIZED_QUATERNION: ")
    core.set_transform(stamped("a", "b", 1.0), "me")
    assert capfd.readouterr().err == (
        "Warning: TF_OLD_DATA ignoring data from the past for frame b at time 1.000000 according to authority me\n"
        "Possible reasons are listed at http://wiki.ros.org/tf/Errors%20explained\n"
    )


def test_translation_that_is_not_a_vector3(core):
    looks_alike = SimpleNamespace(
        header=SimpleNamespace(stamp=TimeMessage(), frame_id="a"),
        child_frame_id="b",
        transform=SimpleNamespace(translation=SimpleNamespace(x=0.0, y=0.0, z=0.0), rotation=Quaternion(w=1.0)),
    )
    with (
        pytest.warns(UserWarning, match="^translation should be of type Vector3$"),
        pytest.raises(TypeError, match=r"^transform.translation must have members x, y, z$"),
    ):
        core.set_transform(looks_alike, "robot")
    with (
        pytest.warns(UserWarning, match="^translation should be of type Vector3$"),
        pytest.raises(TypeError, match=r"^transform.translation must be of type Vector3$"),
    ):
        core.set_transform_static(looks_alike, "robot")


def test_rotation_that_is_not_aquaternion_causes_a_warning(core):
    looks_alike = SimpleNamespace(
        header=SimpleNamespace(stamp=Time(seconds=1), frame_id="a"),
        child_frame_id="f",
        transform=SimpleNamespace(translation=Vector3(x=1.0), rotation=SimpleNamespace(x=0.0, y=0.0, z=0.0, w=1.0)),
    )
    with pytest.warns(UserWarning, match="^translation should be of type Quaternion$"):
        core.set_transform(looks_alike, "robot")
    assert core.lookup_transform_core("a", "f", Time()).transform.translation.x == 1.0


def test_arguments_that_crash_tf2_raise_a_type_error(core, stamped):
    def broken(**changes):
        good = stamped("a", "g", 1.0)
        header = SimpleNamespace(stamp=good.header.stamp, frame_id=changes.get("frame_id", "a"))
        return SimpleNamespace(
            header=header, child_frame_id=changes.get("child", "g"), transform=changes.get("transform", good.transform)
        )

    with pytest.raises(TypeError, match=r"header\.frame_id must be str, not NoneType"):
        core.set_transform(broken(frame_id=None), "robot")
    with pytest.raises(TypeError, match="child_frame_id must be str, not int"):
        core.set_transform(broken(child=3), "robot")
    rotation = SimpleNamespace(x="0", y=0.0, z=0.0, w=1.0)
    with pytest.warns(UserWarning, match="Quaternion"), pytest.raises(TypeError, match="must be numbers"):
        core.set_transform(broken(transform=SimpleNamespace(translation=Vector3(), rotation=rotation)), "robot")
    with pytest.raises(AttributeError):
        core.set_transform(SimpleNamespace(header=SimpleNamespace(stamp=Time(), frame_id="a")), "robot")


def test_stamps_beyond_32_bits_of_seconds(core):
    late = 5_000_000_000_000_000_000
    message = SimpleNamespace(
        header=SimpleNamespace(stamp=SimpleNamespace(nanoseconds=late), frame_id="a"),
        child_frame_id="late",
        transform=SimpleNamespace(translation=Vector3(), rotation=Quaternion(w=1.0)),
    )
    core.set_transform(message, "robot")
    found = core.lookup_transform_core("a", "late", Time())
    assert found.header.stamp.sec * 10**9 + found.header.stamp.nanosec == late
    assert rclpy.time.Time(nanoseconds=late) == core.get_latest_common_time("a", "late")


def test_subclass(stamped):
    class Mine(tf2_py.BufferCore):
        pass

    mine = Mine(Duration(seconds=5))
    mine.set_transform(stamped("a", "b", 1.0), "robot")
    assert mine.can_transform_core("a", "b", Time()) == (1, "")
