"""ROS package statistics_msgs."""

from coframe.workspace import ros_side

ros_side.check("statistics_msgs")
