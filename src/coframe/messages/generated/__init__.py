"""The message classes of each ROS package."""
