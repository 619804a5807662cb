"""ROS package actionlib_msgs."""

from coframe.workspace import ros_side

ros_side.check("actionlib_msgs")
