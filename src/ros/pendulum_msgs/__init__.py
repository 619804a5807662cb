"""ROS package pendulum_msgs."""

from coframe import ros_side

ros_side.check("pendulum_msgs")
