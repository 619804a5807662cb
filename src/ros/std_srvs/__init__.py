"""ROS package std_srvs."""

from coframe.workspace import ros_side

ros_side.check("std_srvs")
