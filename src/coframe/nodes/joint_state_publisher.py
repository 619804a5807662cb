# SPDX-License-Identifier: Apache-2.0
"""The node joint_state_publisher, with the parameters, topics, QoS profiles and log messages of upstream."""

import contextlib
import threading
from collections.abc import Sequence
from typing import Any

from coframe._output.escaping import one_line
from coframe.nodes.program import program, spin_until_shutdown
from coframe.robots import Robot, RobotDescriptionError, load, parse_urdf
from coframe.robots.joint_states import JointStates
from rcl_interfaces.msg import ParameterDescriptor, ParameterType
from rclpy.exceptions import ParameterAlreadyDeclaredException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import String

__all__ = ["JointStatePublisher", "main", "run"]

_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_WARNING_PERIOD = 5.0  # seconds; other nodes can send invalid messages at any rate
_DEFAULTS: dict[str, Any] = {
    "rate": 10,
    "source_list": [],
    "delta": 0.0,
    "publish_default_positions": True,
    "publish_default_velocities": False,
    "publish_default_efforts": False,
    "use_mimic_tags": True,
    "use_smallest_joint_limits": True,
}


class JointStatePublisher(Node):
    """Node that publishes the states of the joints of a robot periodically.

    Args:
        robot: Robot to use until a description is received on `/robot_description`, or None for no robot.
        options: Keyword arguments of Node.

    Attributes:
        robot: Robot whose joint states are published, or None.
        states: Joint states to publish, or None if there is no robot. Access requires `lock`.
        lock: Lock that protects `states`.

    Raises:
        RobotDescriptionError: Mimic joints form a cycle or refer to a joint that does not exist.
        ValueError: A parameter is not valid.
    """

    def __init__(self, robot: Robot | None = None, **options: Any) -> None:
        super().__init__("joint_state_publisher", automatically_declare_parameters_from_overrides=True, **options)
        try:
            self._set_up(robot)
        except BaseException:
            self.destroy_node()  # The caller has no reference to the node.
            raise

    def _set_up(self, robot: Robot | None) -> None:
        """Read the parameters, then publish."""
        for name, default in _DEFAULTS.items():
            kind = ParameterType.PARAMETER_STRING_ARRAY if default == [] else ParameterType.PARAMETER_NOT_SET
            with contextlib.suppress(ParameterAlreadyDeclaredException):
                self.declare_parameter(name, default, ParameterDescriptor(dynamic_typing=True, type=kind))
        self.lock = threading.Lock()
        self.robot: Robot | None = None
        self.states: JointStates | None = None
        self._chosen_parameters: dict[str, Any] = {
            "zeros": {joint: self._number(f"zeros.{joint}") for joint in self.get_parameters_by_prefix("zeros")},
            "dependent": self._dependent_joints(),
            "use_mimic_tags": self._read_switch("use_mimic_tags"),
            "use_smallest_limits": self._read_switch("use_smallest_joint_limits"),
            "positions": self._read_switch("publish_default_positions"),
            "velocities": self._read_switch("publish_default_velocities"),
            "efforts": self._read_switch("publish_default_efforts"),
        }
        self._delta = self._number("delta")
        rate = self._number("rate")
        if not 0.0 < rate <= 1e6:
            raise ValueError(f"The parameter 'rate' must be greater than 0 Hz and at most 1 MHz, but is {rate:g}.")
        if robot is None:
            self.get_logger().info("Waiting for robot_description to be published on the robot_description topic...")
        else:
            self.configure(robot)
        self.create_subscription(String, "robot_description", self._on_description, _LATCHED)
        for source in self._topics("source_list"):
            self.create_subscription(JointState, source, self._on_source, 10)
        self._publisher = self.create_publisher(JointState, "joint_states", 10)
        self.create_timer(1.0 / rate, self._publish)

    def configure(self, robot: Robot) -> None:
        """Use this robot with its default joint positions.

        Raises:
            RobotDescriptionError: Mimic joints form a cycle or refer to a joint that does not exist.
        """
        states = JointStates(robot, **self._chosen_parameters)
        with self.lock:
            self.robot, self.states = robot, states

    def _on_description(self, message: String) -> None:
        if self.robot is not None and message.data == self.robot.text:
            return  # The description has not changed, so the joints keep their positions.
        try:
            robot = parse_urdf(message.data)
        except RobotDescriptionError as error:
            text = one_line(f"Invalid robot_description given, ignoring: {error}")
            self.get_logger().warning(text, throttle_duration_sec=_WARNING_PERIOD)
            return
        try:
            self.configure(robot)
        except RobotDescriptionError as error:
            self.get_logger().error(one_line(str(error)))
            raise

    def _on_source(self, message: JointState) -> None:
        if self.states is None:
            return
        try:
            with self.lock:
                self.states.update(message.name, message.position, message.velocity, message.effort)
        except ValueError as error:
            text = one_line(f"Ignored an invalid JointState message: {error}")
            self.get_logger().warning(text, throttle_duration_sec=_WARNING_PERIOD)

    def _publish(self) -> None:
        if self.states is None:
            return
        with self.lock:
            if self._delta > 0.0:
                self.states.step(self._delta)
            names, positions, velocities, efforts = self.states.fields()
        if not names:
            return
        message = JointState(name=names, position=positions, velocity=velocities, effort=efforts)
        message.header.stamp = self.get_clock().now().to_msg()
        self._publisher.publish(message)

    def _dependent_joints(self) -> dict[str, tuple[str, float, float]]:
        """Return parent, factor and offset of each dependent joint."""
        found: dict[str, dict[str, Any]] = {}
        for name in self.get_parameters_by_prefix("dependent_joints"):
            joint, _, part = name.rpartition(".")
            if not joint or part not in {"parent", "factor", "offset"}:
                raise ValueError(
                    f"Invalid dependent_joint name '{name}'. "
                    "Expected dependent_joints.JOINT.parent, .factor or .offset."
                )
            full = f"dependent_joints.{name}"
            found.setdefault(joint, {})[part] = (
                str(self.get_parameter(full).value) if part == "parent" else self._number(full)
            )
        for joint, parts in found.items():
            if "parent" not in parts:
                raise ValueError(f"All dependent_joints must at least have a parent. '{joint}' has no parent.")
        return {
            joint: (parts["parent"], parts.get("factor", 1.0), parts.get("offset", 0.0))
            for joint, parts in found.items()
        }

    def _number(self, name: str) -> float:
        value = self.get_parameter(name).value
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise ValueError(f"The parameter '{name}' must be a number, but is {value!r}.")  # noqa: TRY004
        return float(value)

    def _read_switch(self, name: str) -> bool:
        value = self.get_parameter(name).value
        if not isinstance(value, bool):
            raise ValueError(f"The parameter '{name}' must be true or false, but is {value!r}.")  # noqa: TRY004
        return value

    def _topics(self, name: str) -> list[str]:
        value = self.get_parameter(name).value
        if value is None:  # `[]` in a parameter file
            return []
        if not isinstance(value, Sequence) or isinstance(value, str) or not all(isinstance(v, str) for v in value):
            raise ValueError(f"The parameter '{name}' must be a list of topics, but is {value!r}.")
        return list(value)


def run(args: list[str], robot: Robot | None = None, *, domain_id: int | None = None, **options: Any) -> None:
    """Run the node until shutdown.

    Args:
        args: Command line with `--ros-args`.
        robot: Robot, as for the node.
        domain_id: ROS domain. None: ROS_DOMAIN_ID or 0.
        options: Keyword arguments of Node.

    Raises:
        RobotDescriptionError: A description, including one received later, is not valid.
        ValueError: A parameter is not valid.
    """
    spin_until_shutdown(lambda: JointStatePublisher(robot, **options), args, domain_id)


def main(args: list[str] | None = None) -> None:
    """Run the console script, whose arguments are an optional file and `--ros-args`."""
    program("joint_state_publisher", args, lambda words, files: run(words, load(files[0]) if files else None))
