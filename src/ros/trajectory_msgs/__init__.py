"""ROS package trajectory_msgs."""

from coframe.workspace import ros_side

ros_side.check("trajectory_msgs")
