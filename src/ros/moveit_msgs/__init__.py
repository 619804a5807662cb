"""ROS package moveit_msgs."""

from coframe.workspace import ros_side

ros_side.check("moveit_msgs")
