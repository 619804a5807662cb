"""ROS package lifecycle_msgs."""

from coframe import ros_side

ros_side.check("lifecycle_msgs")
