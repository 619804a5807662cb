"""ROS package lifecycle_msgs."""

from coframe.workspace import ros_side

ros_side.check("lifecycle_msgs")
