# SPDX-License-Identifier: Apache-2.0
"""The node robot_state_publisher, with the parameters, topics, QoS profiles and log messages of upstream."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe._output.escaping import one_line
from coframe.frame_names import prefix_advice, shared_frames
from coframe.nodes.program import program, spin_until_shutdown
from coframe.robots import Robot, RobotDescriptionError, load, parse_urdf
from coframe.robots.publishing import StatePublisher
from coframe.time import SECOND
from geometry_msgs.msg import TransformStamped
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.time import Time
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.transform.transform import Transform
    from rclpy.publisher import Publisher

__all__ = ["RobotStatePublisher", "main", "run"]

_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_WARNING_PERIOD = 5.0  # seconds; other nodes can send invalid messages at any rate


class RobotStatePublisher(Node):
    """Node that publishes the fixed transforms of a robot once, and the others with every joint state.

    Args:
        file: URDF or xacro file that is used if the parameter `robot_description` is empty.
        options: Keyword arguments of Node.

    Raises:
        RobotDescriptionError: The description is missing or not valid.
    """

    def __init__(self, file: str | None = None, **options: Any) -> None:
        super().__init__("robot_state_publisher", **options)
        description = self.declare_parameter("robot_description", "").value
        hertz = ParameterDescriptor(floating_point_range=[FloatingPointRange(from_value=0.0, to_value=1000.0)])
        frequency = self.declare_parameter("publish_frequency", 20.0, hertz).value
        self._prefix = self.declare_parameter("frame_prefix", "").value
        # An extension of upstream: links without prefix, such as "map,world".
        self._shared_frames = set(shared_frames(self.declare_parameter("frame_prefix_keep", "").value))
        self._warn_about_prefix()
        ignore_stamps = self.declare_parameter("ignore_timestamp", False).value
        # The first name is Lyrical's, the second one Kilted's.
        from_topic = self.declare_parameter("use_robot_description_topic", False).value
        from_topic |= self.declare_parameter("description_from_topic", False).value
        self._frequency, self._ignore_stamps = frequency, ignore_stamps
        self._states: StatePublisher | None = None
        self._broadcaster = TransformBroadcaster(self)
        self._static_broadcaster = StaticTransformBroadcaster(self)
        self._description: Publisher | None = None
        if from_topic:
            self.get_logger().info("Waiting for robot_description to be published on the robot_description topic...")
            self.create_subscription(String, "robot_description", self._on_description, _LATCHED)
        else:
            self._description = self.create_publisher(String, "robot_description", _LATCHED)
            self._publish_robot(self._first_robot(description, file))
        self.add_on_set_parameters_callback(self._set_parameters)
        overrides = QoSOverridingOptions.with_default_policies()
        self.create_subscription(
            JointState, "joint_states", self._on_joint_state, qos_profile_sensor_data, qos_overriding_options=overrides
        )

    def _first_robot(self, description: str, file: str | None) -> Robot:
        if description:
            return parse_urdf(description)
        if file is None:
            raise RobotDescriptionError(
                "robot_description parameter must not be empty", hint="Alternatively, pass a URDF file."
            )
        self.get_logger().warning(
            "No robot_description parameter, but command-line argument available.  "
            "Assuming argument is name of URDF file."
        )
        robot = load(file)
        self.set_parameters([Parameter("robot_description", value=robot.text)])
        return robot

    def _on_description(self, message: String) -> None:
        """Use the description from the topic, as requested by the parameter `use_robot_description_topic`."""
        try:
            self._publish_robot(self._new_robot(message.data))
        except RobotDescriptionError as error:
            self.get_logger().error(one_line(f"Invalid robot_description on the topic, ignored: {error}"))

    def _publish_robot(self, robot: Robot) -> None:
        """Publish the description of a robot and its fixed transforms, then the transforms of its joints."""
        states = StatePublisher(robot, self._frequency, ignore_stamps=self._ignore_stamps)
        self._states = states
        for link in robot.links:
            self.get_logger().info(one_line(f"got segment {link}"))
        for warning in robot.warnings:
            self.get_logger().warning(one_line(warning))
        if self._description is not None:
            self._description.publish(String(data=robot.text))
        now = self.get_clock().now().nanoseconds
        fixed = [self._message(transform, now) for transform in states.fixed()]
        message = self._static_broadcaster.net_message
        # Links of the previous description are removed. Upstream continues to publish them.
        message.transforms, previous = [], message.transforms
        if fixed or previous:
            self._static_broadcaster.sendTransform(fixed)

    def _on_joint_state(self, state: JointState) -> None:
        states = self._states
        if states is None:
            return  # There is no description yet.
        if len(state.name) != len(state.position):
            if not len(state.position):
                text = "Robot state publisher ignored a JointState message without positions"
                self.get_logger().warning(text, throttle_duration_sec=_WARNING_PERIOD)
            else:
                text = "Robot state publisher ignored an invalid JointState message"
                self.get_logger().error(text, throttle_duration_sec=_WARNING_PERIOD)
            return
        if states.has_jumped_back(self.get_clock().now().nanoseconds):
            text = "Moved backwards in time, re-publishing joint transforms!"
            self.get_logger().warning(text, throttle_duration_sec=_WARNING_PERIOD)
        stamp = Time.from_msg(state.header.stamp).nanoseconds
        try:
            moving = states.moving(stamp, state.name, state.position)
        except ValueError as error:
            text = one_line(f"Robot state publisher ignored an invalid JointState message: {error}")
            self.get_logger().error(text, throttle_duration_sec=_WARNING_PERIOD)
            return
        if moving:
            self._broadcaster.sendTransform([self._message(transform, stamp) for transform in moving])

    def _message(self, transform: Transform, stamp: int) -> TransformStamped:
        message = TransformStamped(child_frame_id=self._frame(transform.source or ""))
        message.header.frame_id = self._frame(transform.target or "")
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, SECOND)
        p, q = message.transform.translation, message.transform.rotation
        p.x, p.y, p.z, q.x, q.y, q.z, q.w = transform.values
        return message

    def _frame(self, link: str) -> str:
        return link if link in self._shared_frames else f"{self._prefix}{link}"

    def _warn_about_prefix(self) -> None:
        if self._prefix.startswith("/"):
            self.get_logger().warning(
                f"The frame_prefix {self._prefix!r} begins with a slash, which is removed, because frame names of "
                f"tf2 have none."
            )
        elif advice := prefix_advice(self._prefix):
            self.get_logger().warning(f"The frame_prefix is used as given: {advice}")

    def _set_parameters(self, parameters: Sequence[Parameter[Any]]) -> SetParametersResult:
        """Apply changes of parameters, or reject all of them."""
        given = {parameter.name: parameter.value for parameter in parameters}
        try:
            robot = self._new_robot(given["robot_description"]) if "robot_description" in given else None
        except RobotDescriptionError as error:
            return SetParametersResult(successful=False, reason=str(error))
        if "frame_prefix" in given:
            self._prefix = given["frame_prefix"]
            self._warn_about_prefix()
        if "frame_prefix_keep" in given:
            self._shared_frames = set(shared_frames(given["frame_prefix_keep"]))
        self._frequency = given.get("publish_frequency", self._frequency)
        self._ignore_stamps = given.get("ignore_timestamp", self._ignore_stamps)
        if self._states is not None:
            self._states.frequency, self._states.ignore_stamps = self._frequency, self._ignore_stamps
        if robot is not None:
            self._publish_robot(robot)
        return SetParametersResult(successful=True)

    def _new_robot(self, description: str) -> Robot:
        if not description:
            raise RobotDescriptionError("Empty URDF is not allowed")
        return parse_urdf(description)


def run(args: list[str], file: str | None = None, *, domain_id: int | None = None, **options: Any) -> None:
    """Run the node until shutdown.

    Args:
        args: Command line with `--ros-args`.
        file: URDF or xacro file, as for the node.
        domain_id: ROS domain. None: ROS_DOMAIN_ID or 0.
        options: Keyword arguments of Node.

    Raises:
        RobotDescriptionError: The description is missing or not valid.
    """
    spin_until_shutdown(lambda: RobotStatePublisher(file, **options), args, domain_id)


def main(args: list[str] | None = None) -> None:
    """Run the console script, whose arguments are an optional file and `--ros-args`."""
    program("robot_state_publisher", args, lambda words, files: run(words, files[0] if files else None))
