"""ROS package tf2_msgs."""

from coframe.workspace import ros_side

ros_side.check("tf2_msgs")
