"""Sources that the viewer can show: the ROS graph, a recording or a buffer."""
