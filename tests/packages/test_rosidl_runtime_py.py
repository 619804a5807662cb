# SPDX-License-Identifier: Apache-2.0
"""rosidl_runtime_py: texts that are those of ``ros2 topic echo``, messages from dictionaries, interfaces by name."""

import math
import sys
from array import array
from collections import OrderedDict

import numpy as np
import pytest
import yaml

import rosidl_runtime_py
from action_msgs.srv import CancelGoal
from builtin_interfaces.msg import Time
from coframe.messages import packages
from geometry_msgs.msg import PointStamped, PoseArray
from rcl_interfaces.msg import ParameterValue
from rosidl_runtime_py import (
    get_interface_path,
    get_interfaces,
    get_message_interfaces,
    get_message_slot_types,
    get_service_interfaces,
    message_to_csv,
    message_to_ordereddict,
    message_to_yaml,
    set_message_fields,
)
from rosidl_runtime_py.import_message import import_message_from_namespaced_type
from rosidl_runtime_py.utilities import get_interface, get_message, get_service, is_action, is_message, is_service
from sensor_msgs.msg import Image, Imu, JointState, PointCloud2
from std_msgs.msg import Byte, ByteMultiArray, Float32MultiArray, Header, String
from std_srvs.srv import SetBool
from tf2_msgs.action import LookupTransform

JOINTS = JointState(name=["shoulder", "", "true", "ä: b"], position=[1.0, 1e-5, math.inf, math.nan])

# What `ros2 topic echo` prints for this message.
JOINTS_TEXT = """\
header:
  stamp:
    sec: 0
    nanosec: 0
  frame_id: ''
name:
- shoulder
- ''
- 'true'
- 'ä: b'
position:
- 1.0
- 1.0e-05
- .inf
- .nan
velocity: []
effort: []
"""


def test_yaml_is_that_of_topic_echo():
    assert message_to_yaml(JOINTS) == JOINTS_TEXT
    assert message_to_yaml(String(data="Hello World: 1")) == "data: 'Hello World: 1'\n"
    assert message_to_yaml(PointStamped(), flow_style=True) == (
        "{header: {stamp: {sec: 0, nanosec: 0}, frame_id: ''}, point: {x: 0.0, y: 0.0, z: 0.0}}\n"
    )
    assert message_to_yaml(String(data="word " * 500)).count("\n") == 1, "long texts are not folded"
    assert message_to_yaml(Byte(data=b"\x02")) == 'data: "\\x02"\n'


def test_long_values_are_shortened_as_by_topic_echo():
    image = Image(encoding="mono8", height=1, width=300, step=300, data=array("B", range(200)))
    image.header.frame_id = "x" * 200
    shown = yaml.safe_load(message_to_yaml(image, truncate_length=128))
    assert shown["data"] == [*range(128), "..."]
    assert shown["header"]["frame_id"] == "x" * 128 + "..."
    assert shown["encoding"] == "mono8"
    described = message_to_yaml(image, no_arr=True, no_str=True)
    assert "data: '<sequence type: uint8, length: 200>'\n" in described
    assert "encoding: '<string length: <5>>'\n" in described
    assert "orientation_covariance: '<array type: double[9]>'\n" in message_to_yaml(Imu(), no_arr=True)
    cloud = message_to_yaml(PointCloud2(), no_arr=True)
    assert "fields: '<sequence type: sensor_msgs/msg/PointField, length: 0>'\n" in cloud
    assert "name: '<sequence type: string, length: 4>'\n" in message_to_yaml(JOINTS, no_arr=True)
    exact = message_to_yaml(image, truncate_length=200)
    assert "..." not in exact


def test_csv():
    assert message_to_csv(JOINTS) == "0,0,,shoulder,,true,ä: b,1.0,1e-05,inf,nan,,"
    assert message_to_csv(JOINTS, truncate_length=2) == "0,0,,sh...,,...,1.0,1e-05,...,,"
    image = Image(encoding="mono8", data=array("B", range(4)))
    assert message_to_csv(image, no_arr=True, no_str=True) == (
        "0,0,<string length: <0>>,0,0,<string length: <5>>,0,0,<sequence type: uint8, length: 4>"
    )
    assert message_to_csv(String()) == ""


def test_dictionary_holds_plain_values_in_order():
    imu = Imu()
    imu.orientation_covariance[4] = 0.5
    found = message_to_ordereddict(imu)
    assert list(found) == list(Imu.get_fields_and_field_types())
    assert isinstance(found["orientation"], OrderedDict)
    assert found["orientation_covariance"] == [0.0] * 4 + [0.5] + [0.0] * 4
    assert type(found["orientation_covariance"][4]) is float
    assert message_to_ordereddict(Float32MultiArray(data=[0.1]))["data"] == [float(np.float32(0.1))]
    types = get_message_slot_types(Imu)
    assert import_message_from_namespaced_type(types["header"]) is Header


@pytest.mark.parametrize(
    "message", [JOINTS, Imu(), PoseArray(), ParameterValue(string_value="on"), CancelGoal.Request()]
)
def test_a_message_can_be_made_from_its_text(message):
    copy = type(message)()
    assert set_message_fields(copy, yaml.safe_load(message_to_yaml(message))) == []
    assert message_to_yaml(copy) == message_to_yaml(message)


def test_fields_from_dictionaries():
    message = PoseArray()
    values = {"header": {"frame_id": "map"}, "poses": [{"position": {"x": 1}}, {"orientation": {"w": 0.5}}]}
    set_message_fields(message, values)
    assert (message.header.frame_id, len(message.poses)) == ("map", 2)
    assert (message.poses[0].position.x, message.poses[0].orientation.w) == (1.0, 1.0)
    assert message.poses[1].orientation.w == 0.5
    set_message_fields(message, {"poses": [message.poses[1]]})
    assert [pose.orientation.w for pose in message.poses] == [0.5]
    byte, text = Byte(), String()
    set_message_fields(byte, {"data": 7})
    set_message_fields(text, {"data": 5})
    assert (byte.data, text.data) == (b"\x07", "5")
    numbers = ByteMultiArray()
    for typed in ("[1, 0x41, 255]", "!!binary AUH/"):
        set_message_fields(numbers, yaml.safe_load(f"data: {typed}"))
        assert numbers.data == [b"\x01", b"A", b"\xff"]
    imu = Imu()
    set_message_fields(imu, {"orientation_covariance": [1, 2, 3, 4, 5, 6, 7, 8, 9]})
    assert imu.orientation_covariance.dtype == np.float64


@pytest.mark.parametrize("value", [[256], [-1], ["a"], [1.5], "ab", [b"ab"]])
def test_elements_of_byte_arrays_that_are_not_bytes(value):
    with pytest.raises(TypeError, match="a byte is a number from 0 to 255, not "):
        set_message_fields(ByteMultiArray(), {"data": value})


def test_wrong_fields_and_values():
    with pytest.raises(AttributeError, match="nothing"):
        set_message_fields(String(), {"nothing": 1})
    with pytest.raises(TypeError, match="Value '3' is expected to be a dictionary but is a int"):
        set_message_fields(PointStamped(), {"point": 3})
    with pytest.raises((AssertionError, TypeError, ValueError)):
        set_message_fields(PointStamped(), {"point": {"x": "far"}})


def test_current_time_for_auto_and_now():
    message = PointStamped()
    setters = set_message_fields(message, {"header": "auto"}, expand_header_auto=True)
    header = Header()
    setters += set_message_fields(header, {"stamp": "now"}, expand_time_now=True)
    for setter in setters:
        setter(Time(sec=5))
    assert (message.header.stamp.sec, header.stamp.sec) == (5, 5)
    with pytest.raises(TypeError):
        set_message_fields(message, {"header": "auto"})


def test_interfaces_by_name():
    assert get_message("std_msgs/msg/String") is String
    assert get_service("std_srvs/srv/SetBool") is SetBool
    assert get_interface("tf2_msgs/action/LookupTransform") is LookupTransform
    assert (is_message(String), is_service(String), is_action(String)) == (True, False, False)
    assert (is_message(SetBool), is_service(SetBool), is_action(SetBool)) == (False, True, False)
    assert is_action(LookupTransform)
    with pytest.raises(ValueError, match="Expected 'std_srvs/srv/SetBool' to be a message"):
        get_message("std_srvs/srv/SetBool")
    with pytest.raises(ModuleNotFoundError):
        get_message("no_msgs/msg/String")
    with pytest.raises(AttributeError):
        get_message("std_msgs/msg/Strong")
    with pytest.raises(ValueError, match="full name"):
        get_message("String")


def test_lists_of_interfaces(tmp_path, monkeypatch):
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    assert get_message_interfaces(["std_srvs"]) == {}
    assert get_service_interfaces(["std_srvs"]) == {"std_srvs": ["srv/Empty", "srv/SetBool", "srv/Trigger"]}
    assert {"geometry_msgs", "std_srvs"} <= set(rosidl_runtime_py.get_all_interface_packages())
    assert "rclpy" not in rosidl_runtime_py.get_all_interface_packages()
    with pytest.raises(LookupError, match="no_msgs"):
        get_interfaces(["no_msgs"])
    for file in ("msg/Grip.msg", "srv/Close.srv"):
        path = tmp_path / "share" / "hand_msgs" / file
        path.parent.mkdir(parents=True)
        path.write_text("bool a" if path.suffix == ".msg" else "---\n")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    monkeypatch.syspath_prepend(tmp_path)  # The definitions in this repository are not those of a user.
    packages.forget()
    assert get_interfaces(["hand_msgs"]) == {"hand_msgs": ["msg/Grip", "srv/Close"]}
    assert "hand_msgs" in rosidl_runtime_py.get_interface_packages()
    assert get_interface_path("hand_msgs/msg/Grip") == str(tmp_path / "share" / "hand_msgs" / "msg" / "Grip.msg")
    assert message_to_yaml(get_message("hand_msgs/msg/Grip")()) == "a: false\n"
    with pytest.raises(LookupError, match=r"Could not find the interface 'hand_msgs/srv/Open'"):
        get_interface_path("hand_msgs/srv/Open")
    with pytest.raises(LookupError, match=r"coframe interface show std_msgs/msg/String"):
        get_interface_path("std_msgs/msg/String")
    with pytest.raises(LookupError, match="Unknown package 'no_msgs'"):
        get_interface_path("no_msgs/msg/Grip")
    with pytest.raises(ValueError, match="Expected at least two parts"):
        get_interface_path("Grip")
    monkeypatch.undo()
    packages.forget()


def test_missing_yaml_is_one_sentence(monkeypatch):
    monkeypatch.setitem(sys.modules, "yaml", None)
    with pytest.raises(ModuleNotFoundError, match=r"needs the module yaml.*pip install 'coframe\[params\]'"):
        message_to_yaml(String())
