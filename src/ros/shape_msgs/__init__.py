"""ROS package shape_msgs."""

from coframe.workspace import ros_side

ros_side.check("shape_msgs")
