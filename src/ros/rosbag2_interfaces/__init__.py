"""ROS package rosbag2_interfaces."""

from coframe.workspace import ros_side

ros_side.check("rosbag2_interfaces")
