# SPDX-License-Identifier: Apache-2.0
import pytest

from coframe.wire import names


@pytest.mark.parametrize(
    ("name", "kind", "dds"),
    [
        ("/tf", "topic", "rt/tf"),
        ("/robot1/scan", "topic", "rt/robot1/scan"),
        ("/add_two_ints", "request", "rq/add_two_intsRequest"),
        ("/add_two_ints", "reply", "rr/add_two_intsReply"),
    ],
)
def test_dds_names_of_ros_topics(name, kind, dds):
    assert names.dds_topic(name, kind) == dds
    assert names.ros_topic(dds, kind) == name
    assert names.any_ros_name(dds) == name


def test_a_dds_topic_outside_ros_has_no_ros_name():
    assert names.ros_topic("Square") is None
    assert names.ros_topic("rtsp/x") is None
    assert names.any_ros_name("Square") == "Square"


def test_a_relative_name_raises_an_error():
    with pytest.raises(ValueError, match="'scan' is not fully qualified"):
        names.dds_topic("scan")


def test_dds_names_of_ros_types():
    assert names.dds_type("tf2_msgs/msg/TFMessage") == "tf2_msgs::msg::dds_::TFMessage_"
    assert names.ros_type("std_srvs::srv::dds_::SetBool_Request_") == "std_srvs/srv/SetBool_Request"
    assert names.ros_type("ShapeType") == "ShapeType"


def test_full_names_of_nodes():
    assert names.full_name("/", "talker") == "/talker"
    assert names.full_name("/robot/arm", "talker") == "/robot/arm/talker"
