"""ROS package visualization_msgs."""
