"""ROS package geographic_msgs."""

from coframe import ros_side

ros_side.check("geographic_msgs")
