"""ROS package std_msgs."""
