"""ROS package geographic_msgs."""

from coframe.workspace import ros_side

ros_side.check("geographic_msgs")
