"""ROS package ros_gz_interfaces."""

from coframe.workspace import ros_side

ros_side.check("ros_gz_interfaces")
