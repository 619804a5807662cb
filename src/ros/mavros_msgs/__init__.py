"""ROS package mavros_msgs."""

from coframe.workspace import ros_side

ros_side.check("mavros_msgs")
