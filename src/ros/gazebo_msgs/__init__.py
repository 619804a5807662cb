"""ROS package gazebo_msgs."""

from coframe.workspace import ros_side

ros_side.check("gazebo_msgs")
