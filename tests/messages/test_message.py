"""Message classes behave as Humble's generated ones: constructors, checks and their words, comparing, showing."""

import copy
import os
import pickle
import re
import subprocess
import sys
from array import array
from collections import UserList
from typing import Any

import numpy as np
import pytest

from action_msgs.msg import GoalStatusArray
from action_msgs.srv import CancelGoal
from builtin_interfaces.msg import Duration, Time
from coframe.messages import Message, find
from coframe.messages.definition import BasicType, BoundedString, NamespacedType, UnboundedString
from geometry_msgs.msg import (
    PoseWithCovariance,
    Quaternion,
    Transform,
    TransformStamped,
    Twist,
    Vector3,
)
from nav_msgs.msg import OccupancyGrid
from rcl_interfaces.msg import IntegerRange, Log, ParameterDescriptor, ParameterEvent
from sensor_msgs.msg import CameraInfo, ChannelFloat32, LaserScan, PointCloud2
from std_msgs.msg import (
    Bool,
    Byte,
    ByteMultiArray,
    ColorRGBA,
    Empty,
    Float64MultiArray,
    Header,
    Int8,
    Int32MultiArray,
    String,
    UInt8MultiArray,
)
from std_srvs.srv import SetBool, Trigger
from tf2_msgs.action import LookupTransform
from tf2_msgs.msg import TFMessage
from unique_identifier_msgs.msg import UUID
from visualization_msgs.msg import Marker

DOUBLE_BOUND = f"{1.7976931348623157e308:f}"


def refusal(action: Any) -> str:
    """What the AssertionError of an action says."""
    with pytest.raises(AssertionError) as caught:
        action()
    return str(caught.value)


def assigning(message: Any, name: str, value: Any) -> Any:
    return lambda: setattr(message, name, value)


class TestConstructor:
    def test_defaults_are_those_of_ros(self) -> None:
        transform = TransformStamped()
        assert (transform.header.stamp.sec, transform.header.frame_id) == (0, "")
        assert transform.transform.rotation == Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
        assert (Quaternion.W__DEFAULT, ParameterDescriptor.DYNAMIC_TYPING__DEFAULT) == (1.0, False)
        assert Byte().data == b"\0"
        assert Bool().data is False
        scan, info = LaserScan(), CameraInfo()
        assert (type(scan.ranges), scan.ranges.typecode, len(scan.ranges)) == (array, "f", 0)
        assert (info.k.dtype, info.k.shape, info.d.typecode) == (np.float64, (9,), "d")
        assert TFMessage().transforms == []
        assert UUID().uuid.dtype == np.uint8

    def test_defaults_are_not_shared(self) -> None:
        first = TFMessage()
        first.transforms.append(TransformStamped())
        assert TFMessage().transforms == []
        assert Transform().rotation is not Transform().rotation

    def test_takes_every_field_by_name(self) -> None:
        stamp = Time(sec=3, nanosec=4)
        header = Header(stamp=stamp, frame_id="map")
        assert header.stamp is stamp
        assert TransformStamped(header=header).header.frame_id == "map"

    def test_refuses_other_names_in_rosidl_s_words(self) -> None:
        said = refusal(lambda: Vector3(w=1.0, x=1.0, a=2))  # type: ignore[call-arg]
        assert said == "Invalid arguments passed to constructor: a, w"
        with pytest.raises(TypeError):
            Vector3(1.0)  # type: ignore[misc]

    def test_checks_what_it_is_given(self) -> None:
        assert refusal(lambda: Vector3(x=1)) == "The 'x' field must be of type 'float'"
        assert "sub message of type 'Header'" in refusal(lambda: TransformStamped(header=None))  # type: ignore[arg-type]
        assert "sub message of type 'Header'" in refusal(lambda: TransformStamped(header=0))  # type: ignore[arg-type]

    def test_numbers_may_come_in_any_iterable(self) -> None:
        assert LaserScan(ranges=np.array([1, 2])).ranges == array("f", [1.0, 2.0])
        assert LaserScan(ranges=[1, 2]).ranges == array("f", [1.0, 2.0])
        assert UInt8MultiArray(data=b"\1\2").data == array("B", [1, 2])
        assert PoseWithCovariance(covariance=range(36)).covariance.tolist() == [float(i) for i in range(36)]

    def test_arrays_must_have_their_size(self) -> None:
        assert refusal(lambda: CameraInfo(k=[1.0] * 8)) == "The 'k' numpy.ndarray() must have a size of 9"
        assert "one row of 9" in refusal(lambda: CameraInfo(k=np.eye(3)))


class TestSetters:
    @pytest.mark.parametrize(
        ("message", "name", "value", "said"),
        [
            (Vector3(), "x", 0, "The 'x' field must be of type 'float'"),
            (Vector3(), "x", None, "The 'x' field must be of type 'float'"),
            (ColorRGBA(), "r", 1e39, "The 'r' field must be a float in [-3.402823466e+38, 3.402823466e+38]"),
            (ColorRGBA(), "r", 1, "The 'r' field must be of type 'float'"),
            (Time(), "sec", 1.0, "The 'sec' field must be of type 'int'"),
            (Time(), "sec", np.int32(1), "The 'sec' field must be of type 'int'"),
            (Time(), "sec", 2**31, "The 'sec' field must be an integer in [-2147483648, 2147483647]"),
            (Time(), "nanosec", -1, "The 'nanosec' field must be an unsigned integer in [0, 4294967295]"),
            (Int8(), "data", 128, "The 'data' field must be an integer in [-128, 127]"),
            (Bool(), "data", 1, "The 'data' field must be of type 'bool'"),
            (String(), "data", b"a", "The 'data' field must be of type 'str'"),
            (
                Byte(),
                "data",
                b"ab",
                "The 'data' field must be of type 'bytes' or 'ByteString' with length 1",
            ),
            (Header(), "stamp", Duration(), "The 'stamp' field must be a sub message of type 'Time'"),
            (
                TFMessage(),
                "transforms",
                TransformStamped(),
                "The 'transforms' field must be a set or sequence and each value of type 'TransformStamped'",
            ),
            (
                TFMessage(),
                "transforms",
                [Transform()],
                "The 'transforms' field must be a set or sequence and each value of type 'TransformStamped'",
            ),
            (
                ParameterDescriptor(),
                "integer_range",
                [IntegerRange(), IntegerRange()],
                (
                    "The 'integer_range' field must be a set or sequence with length at most 1 "
                    "and each value of type 'IntegerRange'"
                ),
            ),
            (
                ByteMultiArray(),
                "data",
                [1],
                "The 'data' field must be a set or sequence and each value of type 'bytes'",
            ),
            (
                PointCloud2(),
                "data",
                [256],
                (
                    "The 'data' field must be a set or sequence and each value of type 'int' "
                    "and each unsigned integer in [0, 255]"
                ),
            ),
            (
                OccupancyGrid(),
                "data",
                "abc",
                (
                    "The 'data' field must be a set or sequence and each value of type 'int' "
                    "and each integer in [-128, 127]"
                ),
            ),
            (
                OccupancyGrid(),
                "data",
                array("B"),
                "The 'data' array.array() must have the type code of 'b'",
            ),
            (
                LaserScan(),
                "ranges",
                [1],
                (
                    "The 'ranges' field must be a set or sequence and each value of type 'float' and each float in "
                    "[-340282346600000016151267322115014000640.000000, 340282346600000016151267322115014000640.000000]"
                ),
            ),
            (
                CameraInfo(),
                "k",
                [1.0],
                (
                    "The 'k' field must be a set or sequence with length 9 and each value of type 'float' "
                    f"and each double in [-{DOUBLE_BOUND}, {DOUBLE_BOUND}]"
                ),
            ),
            (
                CameraInfo(),
                "k",
                np.zeros(9, np.float32),
                "The 'k' numpy.ndarray() must have the dtype of 'numpy.float64'",
            ),
            (CameraInfo(), "k", np.zeros(8), "The 'k' numpy.ndarray() must have a size of 9"),
        ],
    )
    def test_refuse_in_humble_s_words(self, message: Any, name: str, value: Any, said: str) -> None:
        before = repr(message)
        assert refusal(assigning(message, name, value)) == said
        assert repr(message) == before

    def test_numpy_floats_and_special_values_pass(self) -> None:
        vector = Vector3(x=np.float64(1.5))
        vector.y, vector.z = float("nan"), float("inf")
        color = ColorRGBA(r=float("inf"))
        assert (vector.x, color.r) == (1.5, float("inf"))

    def test_sequences_of_float_take_infinity_and_nan_but_not_too_much(self) -> None:
        scan = LaserScan()
        scan.ranges = [float("nan"), float("inf"), 1.0, float("-inf")]
        assert scan.ranges[1:] == array("f", [float("inf"), 1.0, float("-inf")])
        for values in ([float("nan"), 1e39], [1.0, float("nan"), -1e39], [float("inf"), 1e39]):
            assert "each float in" in refusal(assigning(scan, "ranges", values))

    def test_sequences_of_numbers_become_arrays(self) -> None:
        message = Int32MultiArray()
        for values in ([1, 2], (1, 2), {1, 2}, UserList([1, 2])):
            message.data = values  # type: ignore[assignment]
            assert message.data == array("i", [1, 2])
        kept = array("i", [5])
        message.data = kept
        assert message.data is kept
        cloud = PointCloud2()
        cloud.data = b"\1\2"
        assert cloud.data == array("B", [1, 2])

    def test_numpy_is_no_sequence_for_a_sequence_of_numbers(self) -> None:
        assert "a set or sequence" in refusal(assigning(LaserScan(), "ranges", np.zeros(3)))

    def test_arrays_of_numbers_become_numpy(self) -> None:
        info = CameraInfo()
        info.k = [1.0] * 9
        assert info.k.tolist() == [1.0] * 9
        matrix = np.eye(3)
        info.k = matrix
        assert info.k is matrix

    def test_bounded_texts(self) -> None:
        bounded = type(Message)(
            "Bounded",
            (Message,),
            {"ROS_TYPE": "demo_msgs/msg/Bounded", "__slots__": ["_name"], "SLOT_TYPES": (BoundedString(3),)},
        )
        message = bounded(name="abc")
        said = refusal(assigning(message, "name", "abcd"))
        assert said == "The 'name' field must be string value not longer than 3"

    def test_unknown_attributes_do_not_exist(self) -> None:
        with pytest.raises(AttributeError):
            Vector3().w = 1.0  # type: ignore[attr-defined]


def run(code: str, *options: str, **environment: str) -> str:
    done = subprocess.run(
        [sys.executable, *options, "-c", code],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


UNCHECKED = """
from geometry_msgs.msg import Vector3
from sensor_msgs.msg import LaserScan, CameraInfo
from coframe.messages import deserialize, serialize
vector = Vector3(x=1, w=2)
vector.y = 2
scan = LaserScan()
scan.ranges = [1, 2]
info = CameraInfo()
info.k = [1] * 9
print(vector.x, vector.y, deserialize(serialize(vector), Vector3), scan.ranges, info.k.dtype)
"""


@pytest.mark.parametrize(("options", "check"), [((), "0"), (("-O",), "1")])
def test_checks_can_be_switched_off(options: tuple[str, ...], check: str) -> None:
    said = run(UNCHECKED, *options, ROS_PYTHON_CHECK_FIELDS=check)
    assert said == "1 2 geometry_msgs.msg.Vector3(x=1.0, y=2.0, z=0.0) array('f', [1.0, 2.0]) float64"


class TestShowing:
    def test_repr_is_rosidl_s(self) -> None:
        assert repr(Header(stamp=Time(sec=1), frame_id="a")) == (
            "std_msgs.msg.Header(stamp=builtin_interfaces.msg.Time(sec=1, nanosec=0), frame_id='a')"
        )
        assert repr(ChannelFloat32(name="i", values=[1.0])) == "sensor_msgs.msg.ChannelFloat32(name='i', values=[1.0])"
        assert repr(ChannelFloat32()) == "sensor_msgs.msg.ChannelFloat32(name='', values=[])"
        assert repr(Empty()) == "std_msgs.msg.Empty()"
        assert "uuid=array([0, 0," in repr(UUID())
        assert repr(SetBool.Request(data=True)) == "std_srvs.srv.SetBool_Request(data=True)"

    def test_names(self) -> None:
        assert (TransformStamped.__module__, TransformStamped.__name__) == ("geometry_msgs.msg", "TransformStamped")
        assert TransformStamped.ROS_TYPE == "geometry_msgs/msg/TransformStamped"

    def test_fields_and_their_types(self) -> None:
        assert TransformStamped.get_fields_and_field_types() == {
            "header": "std_msgs/Header",
            "child_frame_id": "string",
            "transform": "geometry_msgs/Transform",
        }
        assert PoseWithCovariance.get_fields_and_field_types()["covariance"] == "double[36]"
        assert TFMessage().get_fields_and_field_types() == {"transforms": "sequence<geometry_msgs/TransformStamped>"}
        ranges = ParameterDescriptor.get_fields_and_field_types()
        assert ranges["integer_range"] == "sequence<rcl_interfaces/IntegerRange, 1>"
        assert (ranges["read_only"], Byte.get_fields_and_field_types()["data"]) == ("boolean", "octet")
        TFMessage.get_fields_and_field_types().clear()
        assert TFMessage.get_fields_and_field_types()

    def test_slots_and_their_types(self) -> None:
        assert TransformStamped.__slots__ == ["_header", "_child_frame_id", "_transform"]
        assert (
            NamespacedType(("std_msgs", "msg"), "Header"),
            UnboundedString(),
            NamespacedType(("geometry_msgs", "msg"), "Transform"),
        ) == TransformStamped.SLOT_TYPES
        assert isinstance(Bool.SLOT_TYPES[0], BasicType)
        assert Bool.SLOT_TYPES[0].typename == "boolean"


class TestComparing:
    def test_by_value(self) -> None:
        assert Vector3(x=1.0) == Vector3(x=1.0)
        assert Vector3(x=1.0) != Vector3()
        assert TFMessage(transforms=[TransformStamped()]) == TFMessage(transforms=[TransformStamped()])
        assert Vector3() != Twist()
        assert Vector3(x=float("nan")) != Vector3(x=float("nan"))

    def test_arrays_differ_if_one_number_does(self) -> None:
        first, second = PoseWithCovariance(), PoseWithCovariance()
        assert first == second
        second.covariance[7] = 1.0
        assert first != second

    def test_messages_are_not_hashable(self) -> None:
        with pytest.raises(TypeError, match="unhashable"):
            hash(Vector3())

    @pytest.mark.parametrize(
        "message",
        [
            TransformStamped(child_frame_id="a"),
            CameraInfo(d=[1.0], k=[2.0] * 9),
            SetBool.Request(data=True),
            ParameterEvent(node="n"),
        ],
    )
    def test_copies_are_equal_and_apart(self, message: Any) -> None:
        for other in (copy.copy(message), copy.deepcopy(message), pickle.loads(pickle.dumps(message))):
            assert other == message
            assert type(other) is type(message)
        if isinstance(message, TransformStamped):
            assert copy.deepcopy(message).header is not message.header


class TestConstants:
    def test_on_classes_and_objects(self) -> None:
        assert (Marker.ARROW, Marker().DELETEALL, Log.DEBUG) == (0, 3, b"\n")

    def test_cannot_be_assigned(self) -> None:
        with pytest.raises(AttributeError, match=r"Marker.ARROW is a constant"):
            Marker.ARROW = 5  # type: ignore[misc]
        with pytest.raises(AttributeError):
            Marker().ARROW = 5  # type: ignore[misc]
        assert Marker.ARROW == 0


class TestServicesAndActions:
    def test_a_service_is_its_request_and_response(self) -> None:
        assert SetBool.ROS_TYPE == "std_srvs/srv/SetBool"
        assert SetBool.Response(success=True, message="done").message == "done"
        assert Trigger.Request() == Trigger.Request()
        assert CancelGoal.Response.ERROR_REJECTED == 1
        with pytest.raises(NotImplementedError, match="Service classes can not be instantiated"):
            SetBool()

    def test_an_action_is_its_messages_and_what_carries_them(self) -> None:
        assert LookupTransform.Goal(target_frame="map").target_frame == "map"
        assert LookupTransform.Result().error.NO_ERROR == 0
        assert LookupTransform.Feedback() == LookupTransform.Feedback()
        implementation = LookupTransform.Impl
        request = implementation.SendGoalService.Request(goal_id=UUID(), goal=LookupTransform.Goal())
        assert request.get_fields_and_field_types() == {
            "goal_id": "unique_identifier_msgs/UUID",
            "goal": "tf2_msgs/LookupTransform_Goal",
        }
        assert list(implementation.GetResultService.Response.get_fields_and_field_types()) == ["status", "result"]
        assert list(implementation.FeedbackMessage.get_fields_and_field_types()) == ["goal_id", "feedback"]
        assert implementation.CancelGoalService is CancelGoal
        assert implementation.GoalStatusMessage is GoalStatusArray
        with pytest.raises(NotImplementedError, match="Action classes can not be instantiated"):
            LookupTransform()


class TestFind:
    def test_finds_what_the_packages_export(self) -> None:
        assert find("tf2_msgs/msg/TFMessage") is TFMessage
        assert find("std_srvs/srv/SetBool") is SetBool
        assert find("std_srvs/srv/SetBool_Request") is SetBool.Request
        assert find("tf2_msgs/action/LookupTransform") is LookupTransform
        assert find("std_msgs/msg/Float64MultiArray") is Float64MultiArray

    def test_imports_only_what_it_needs(self) -> None:
        code = "import sys; from coframe.messages import find; find('std_msgs/msg/String'); print(*sys.modules)"
        assert "coframe.messages.generated.sensor_msgs.msg" not in run(code).split()

    @pytest.mark.parametrize(
        ("name", "said"),
        [
            ("TFMessage", "'TFMessage' is not the full name"),
            ("../msg/x", "is not the full name"),
            ("nobody_msgs/msg/Thing", "there is no nobody_msgs/msg/Thing: coframe has no package nobody_msgs"),
            ("std_srvs/msg/Thing", "coframe has no package std_srvs with msg types"),
            ("std_msgs/msg/Strin", "package std_msgs has no msg type Strin"),
        ],
    )
    def test_says_what_is_missing(self, name: str, said: str) -> None:
        with pytest.raises(LookupError, match=re.escape(said)):
            find(name)
