"""ROS package pendulum_msgs."""

from coframe.workspace import ros_side

ros_side.check("pendulum_msgs")
