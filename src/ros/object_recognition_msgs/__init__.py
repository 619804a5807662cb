"""ROS package object_recognition_msgs."""

from coframe.workspace import ros_side

ros_side.check("object_recognition_msgs")
