"""ROS package visualization_msgs."""

from coframe import ros_side

ros_side.check("visualization_msgs")
