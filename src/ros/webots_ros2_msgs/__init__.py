"""ROS package webots_ros2_msgs."""

from coframe.workspace import ros_side

ros_side.check("webots_ros2_msgs")
