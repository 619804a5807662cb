"""ROS package std_msgs."""

from coframe.workspace import ros_side

ros_side.check("std_msgs")
