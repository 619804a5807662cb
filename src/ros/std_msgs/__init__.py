"""ROS package std_msgs."""

from coframe import ros_side

ros_side.check("std_msgs")
