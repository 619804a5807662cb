"""Reading and making `sensor_msgs/PointCloud2` with numpy, as the ROS 2 package `sensor_msgs_py` does."""

from coframe import ros_side

ros_side.check(__name__)
