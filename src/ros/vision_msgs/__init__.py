"""ROS package vision_msgs."""

from coframe.workspace import ros_side

ros_side.check("vision_msgs")
