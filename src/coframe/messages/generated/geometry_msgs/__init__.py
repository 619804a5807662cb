"""ROS package geometry_msgs."""
