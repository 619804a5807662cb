#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Broadcast the transforms of a two-link arm, from joint states or from a simulation if there are none.

Try it:
    dynamic_tf_broadcaster --ros-args -p rate:=100.0

Parameters:
    rate: the rate of the simulated arm, in Hz
    publish_joint_states: whether to publish joint states of the simulated arm instead of its transforms, for
        robot_state_publisher
    joint_timeout: the time without joint states after which the simulation resumes, in seconds
    joint_names: the names of the arm's joints in the joint states
    joint_states_topic: the topic of the joint states
    link_lengths, base_height: the dimensions of the arm, in meters
    base_frame, link1_frame, link2_frame, end_effector_frame: the frame names
"""

import math
import sys
from typing import Any

import rclpy
from geometry_msgs.msg import TransformStamped
from rcl_interfaces.msg import SetParametersResult
from rclpy.exceptions import NameValidationException, ParameterException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.time import Time
from sensor_msgs.msg import JointState
from tf2_ros import TransformBroadcaster


class DynamicFramePublisher(Node):
    """A node that publishes the dynamic transforms of the arm."""

    def __init__(self) -> None:
        super().__init__("dynamic_tf_broadcaster")
        rate = self.declare_parameter("rate", 50.0).value
        if not rate > 0.0:
            raise ValueError(f"parameter 'rate' must be greater than 0 Hz, but is {rate}")
        self.period = 1.0 / rate
        self.joint_timeout = self.declare_parameter("joint_timeout", 1.0).value
        self.joint_names = list(self.declare_parameter("joint_names", ["joint1", "joint2"]).value)
        self.link_lengths = list(self.declare_parameter("link_lengths", [0.5, 0.4]).value)
        self.base_height = self.declare_parameter("base_height", 0.1).value
        self.base_frame = self.declare_parameter("base_frame", "base_link").value
        self.link1_frame = self.declare_parameter("link1_frame", "link1").value
        self.link2_frame = self.declare_parameter("link2_frame", "link2").value
        self.end_effector_frame = self.declare_parameter("end_effector_frame", "end_effector").value
        if len(self.joint_names) != 2 or len(self.link_lengths) != 2:
            raise ValueError(
                "parameters 'joint_names' and 'link_lengths' must have two entries each, because the arm has two joints"
            )

        topic = self.declare_parameter("joint_states_topic", "/joint_states").value
        self.joint_pub = None
        if self.declare_parameter("publish_joint_states", False).value:
            self.joint_pub = self.create_publisher(JointState, topic, 10)
        else:
            self.tf_broadcaster = TransformBroadcaster(self)
            self.joint_sub = self.create_subscription(JointState, topic, self.joint_callback, 10)
        self.timer = self.create_timer(self.period, self.simulate_and_broadcast)

        self.sim_time = 0.0
        self.last_tick: Time | None = None
        self.last_joint_state: Time | None = None
        self.add_on_set_parameters_callback(self.change_parameters)
        self.get_logger().info("Dynamic TF broadcaster started")

    def change_parameters(self, parameters: list[Any]) -> SetParametersResult:
        """Apply a new rate. Changes of other parameters are rejected, because the node reads them only at startup."""
        for parameter in parameters:
            if parameter.name == "rate" and not parameter.value > 0.0:
                return SetParametersResult(successful=False, reason="the rate must be greater than 0 Hz")
            if parameter.name not in {"rate", "use_sim_time"}:
                reason = f"'{parameter.name}' is read when the node starts: restart the node to change it"
                return SetParametersResult(successful=False, reason=reason)
        for parameter in parameters:
            if parameter.name == "rate":
                self.period = 1.0 / parameter.value
                self.timer.timer_period_ns = int(self.period * 1e9)
        return SetParametersResult(successful=True)

    def simulate_and_broadcast(self) -> None:
        """Simulate the motion of the joints and broadcast it, unless a robot publishes joint states."""
        now = self.get_clock().now()
        elapsed = self.seconds_between(self.last_tick, now)
        self.last_tick = now
        if self.robot_is_active(now):
            return
        # The motion follows the stamps. If the clock jumps back, the motion continues by one period.
        self.sim_time += self.period if elapsed is None or elapsed < 0.0 else elapsed
        q1 = 0.5 * math.sin(2 * math.pi * 0.2 * self.sim_time)
        q2 = 0.3 * math.sin(2 * math.pi * 0.3 * self.sim_time + math.pi / 4)
        if self.joint_pub is None:
            self.broadcast_arm_transforms(q1, q2, now)
            return
        state = JointState(name=self.joint_names, position=[q1, q2])
        state.header.stamp = now.to_msg()
        self.joint_pub.publish(state)

    def robot_is_active(self, now: Time) -> bool:
        """Return whether joint states arrived recently. Two sources at the same time would make the arm flicker."""
        age = self.seconds_between(self.last_joint_state, now)
        if age is not None and 0.0 <= age < self.joint_timeout:
            return True
        if self.last_joint_state is not None:
            self.last_joint_state = None
            self.get_logger().info("No more joint states: the simulation of the arm resumes")
        return False

    def joint_callback(self, msg: JointState) -> None:
        """Broadcast the transforms that belong to a joint state of the robot."""
        try:
            q1, q2 = self.arm_positions(msg)
        except ValueError as e:
            self.get_logger().warning(f"Joint state ignored: {e}", throttle_duration_sec=5.0)
            return
        now = self.get_clock().now()
        if self.last_joint_state is None:
            self.get_logger().info("Received joint states: the arm follows them instead of the simulation")
        self.last_joint_state = now
        stamp = Time.from_msg(msg.header.stamp)
        self.broadcast_arm_transforms(q1, q2, stamp if stamp.nanoseconds else now)

    def arm_positions(self, msg: JointState) -> tuple[float, float]:
        """Return the angles of the two joints, in radians.

        If the message has neither name, its first two positions are used.

        Raises:
            ValueError: The message does not contain two valid positions.
        """
        names = list(msg.name)
        found = [name for name in self.joint_names if name in names]
        if len(found) == 1:
            raise ValueError(f"the message has only {found[0]!r} of the joints {self.joint_names}")
        first, second = (names.index(name) for name in found) if found else (0, 1)
        if len(msg.position) <= max(first, second):
            raise ValueError(f"the message has {len(names)} names and {len(msg.position)} positions")
        q1, q2 = msg.position[first], msg.position[second]
        if not (math.isfinite(q1) and math.isfinite(q2)):
            raise ValueError(f"the positions {q1} and {q2} are not finite")
        return q1, q2

    def broadcast_arm_transforms(self, q1: float, q2: float, time: Time) -> None:
        """Broadcast all transforms of the arm in one message, so that listeners always receive a consistent arm."""
        stamp = time.to_msg()

        # base -> link1: a rotation about z at the height of the first joint.
        t1 = TransformStamped()
        t1.header.stamp = stamp
        t1.header.frame_id = self.base_frame
        t1.child_frame_id = self.link1_frame
        t1.transform.translation.z = self.base_height
        t1.transform.rotation.z = math.sin(q1 / 2)
        t1.transform.rotation.w = math.cos(q1 / 2)

        # link1 -> link2: a rotation about z at the end of link1.
        t2 = TransformStamped()
        t2.header.stamp = stamp
        t2.header.frame_id = self.link1_frame
        t2.child_frame_id = self.link2_frame
        t2.transform.translation.x = self.link_lengths[0]
        t2.transform.rotation.z = math.sin(q2 / 2)
        t2.transform.rotation.w = math.cos(q2 / 2)

        # link2 -> end effector: a fixed translation along link2.
        t3 = TransformStamped()
        t3.header.stamp = stamp
        t3.header.frame_id = self.link2_frame
        t3.child_frame_id = self.end_effector_frame
        t3.transform.translation.x = self.link_lengths[1]
        t3.transform.rotation.w = 1.0

        self.tf_broadcaster.sendTransform([t1, t2, t3])

    @staticmethod
    def seconds_between(earlier: Time | None, later: Time) -> float | None:
        """Return the seconds between two times, or None if there is no earlier one."""
        return None if earlier is None else (later - earlier).nanoseconds * 1e-9


def main(args: list[str] | None = None) -> None:
    """Run the node until it is interrupted."""
    node = None
    try:
        rclpy.init(args=args)
        node = DynamicFramePublisher()
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except (RuntimeError, NameValidationException, ParameterException, ValueError) as error:
        sys.exit(f"dynamic_tf_broadcaster: {error}")
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
