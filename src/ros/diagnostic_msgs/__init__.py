"""ROS package diagnostic_msgs."""

from coframe import ros_side

ros_side.check("diagnostic_msgs")
