"""ROS package rosgraph_msgs."""
