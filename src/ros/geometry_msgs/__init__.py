"""ROS package geometry_msgs."""

from coframe.workspace import ros_side

ros_side.check("geometry_msgs")
