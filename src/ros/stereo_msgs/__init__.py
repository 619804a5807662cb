"""ROS package stereo_msgs."""

from coframe.workspace import ros_side

ros_side.check("stereo_msgs")
