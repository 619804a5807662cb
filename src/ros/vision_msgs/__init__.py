"""ROS package vision_msgs."""

from coframe import ros_side

ros_side.check("vision_msgs")
