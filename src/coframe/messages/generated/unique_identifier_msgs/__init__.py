"""ROS package unique_identifier_msgs."""
