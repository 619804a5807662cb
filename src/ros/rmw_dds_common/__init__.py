"""ROS package rmw_dds_common."""

from coframe.workspace import ros_side

ros_side.check("rmw_dds_common")
