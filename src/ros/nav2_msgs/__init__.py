"""ROS package nav2_msgs."""

from coframe.workspace import ros_side

ros_side.check("nav2_msgs")
