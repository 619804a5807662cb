"""ROS package builtin_interfaces."""
