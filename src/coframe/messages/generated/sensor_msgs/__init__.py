"""ROS package sensor_msgs."""
