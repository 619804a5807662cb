# SPDX-License-Identifier: Apache-2.0
"""Conversion between `sensor_msgs/PointCloud2` and NumPy arrays with the API of the ROS 2 package `sensor_msgs_py`."""
