"""ROS package sensor_msgs."""

from coframe.workspace import ros_side

ros_side.check("sensor_msgs")
