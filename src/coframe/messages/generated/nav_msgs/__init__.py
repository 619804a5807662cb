"""ROS package nav_msgs."""
