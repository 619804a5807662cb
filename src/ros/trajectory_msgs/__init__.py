"""ROS package trajectory_msgs."""

from coframe import ros_side

ros_side.check("trajectory_msgs")
