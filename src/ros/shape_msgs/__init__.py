"""ROS package shape_msgs."""

from coframe import ros_side

ros_side.check("shape_msgs")
