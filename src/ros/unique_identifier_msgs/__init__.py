"""ROS package unique_identifier_msgs."""

from coframe.workspace import ros_side

ros_side.check("unique_identifier_msgs")
