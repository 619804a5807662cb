"""ROS package type_description_interfaces."""

from coframe.workspace import ros_side

ros_side.check("type_description_interfaces")
