"""ROS package octomap_msgs."""

from coframe.workspace import ros_side

ros_side.check("octomap_msgs")
