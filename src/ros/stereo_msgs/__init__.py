"""ROS package stereo_msgs."""

from coframe import ros_side

ros_side.check("stereo_msgs")
