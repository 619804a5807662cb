"""ROS package diagnostic_msgs."""

from coframe.workspace import ros_side

ros_side.check("diagnostic_msgs")
