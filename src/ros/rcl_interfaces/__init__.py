"""ROS package rcl_interfaces."""
