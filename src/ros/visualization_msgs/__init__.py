"""ROS package visualization_msgs."""

from coframe.workspace import ros_side

ros_side.check("visualization_msgs")
