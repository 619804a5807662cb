"""ROS package apriltag_msgs."""

from coframe.workspace import ros_side

ros_side.check("apriltag_msgs")
