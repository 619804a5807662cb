"""ROS package std_srvs."""
