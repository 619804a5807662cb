"""ROS package action_msgs."""
