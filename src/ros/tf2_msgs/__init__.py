"""ROS package tf2_msgs."""
