"""The node: upstream's parameters, topics, QoS and texts."""

import contextlib
import threading
from collections.abc import Sequence
from typing import Any

from coframe.robots import Robot, RobotDescriptionError, load, parse_urdf
from coframe.robots.joint_states import JointStates
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.exceptions import ParameterAlreadyDeclaredException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from robot_state_publisher import program, spin_until_ended
from sensor_msgs.msg import JointState
from std_msgs.msg import String

__all__ = ["JointStatePublisher", "main", "run"]

_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
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
    """Publishes the states of a robot's joints again and again.

    Args:
        robot: The robot, until `/robot_description` tells of one; None: there is none until then.
        options: As of Node.

    Attributes:
        robot: The robot whose joints are told of; None until there is one.
        states: What is told; None until there is a robot. To be used under `lock`.
        lock: Guards `states`.

    Raises:
        RobotDescriptionError: Joints follow each other in a circle, or one that is not there.
        ValueError: A parameter makes no sense.
    """

    def __init__(self, robot: Robot | None = None, **options: Any) -> None:
        super().__init__("joint_state_publisher", automatically_declare_parameters_from_overrides=True, **options)
        for name, default in _DEFAULTS.items():
            with contextlib.suppress(ParameterAlreadyDeclaredException):
                self.declare_parameter(name, default, ParameterDescriptor(dynamic_typing=True))
        self.lock = threading.Lock()
        self.robot: Robot | None = None
        self.states: JointStates | None = None
        self._choices: dict[str, Any] = {
            "zeros": {joint: self._number(f"zeros.{joint}") for joint in self.get_parameters_by_prefix("zeros")},
            "dependent": self._dependent_joints(),
            "use_mimic_tags": self._switch("use_mimic_tags"),
            "use_smallest_limits": self._switch("use_smallest_joint_limits"),
            "positions": self._switch("publish_default_positions"),
            "velocities": self._switch("publish_default_velocities"),
            "efforts": self._switch("publish_default_efforts"),
        }
        self._delta = self._number("delta")
        rate = self._number("rate")
        if not 0.0 < rate <= 1e6:
            raise ValueError(f"parameter 'rate' must be more than 0 per second, but is {rate:g}")
        if robot is None:
            self.get_logger().info("Waiting for robot_description to be published on the robot_description topic...")
        else:
            self.configure(robot)
        self.create_subscription(String, "robot_description", self._take_description, _LATCHED)
        for source in self._topics("source_list"):
            self.create_subscription(JointState, source, self._take_source, 10)
        self._publisher = self.create_publisher(JointState, "joint_states", 10)
        self.create_timer(1.0 / rate, self._tell)

    def configure(self, robot: Robot) -> None:
        """From now on tells of this robot, from its rest on.

        Raises:
            RobotDescriptionError: As of the node.
        """
        states = JointStates(robot, **self._choices)
        with self.lock:
            self.robot, self.states = robot, states

    def _take_description(self, message: String) -> None:
        if self.robot is not None and message.data == self.robot.text:
            return  # it was known, and joints that were moved stay where they are
        try:
            robot = parse_urdf(message.data)
        except RobotDescriptionError as error:
            self.get_logger().warning(f"Invalid robot_description given, ignoring: {error}")
            return
        try:
            self.configure(robot)
        except RobotDescriptionError as error:
            self.get_logger().error(str(error))
            raise

    def _take_source(self, message: JointState) -> None:
        if self.states is None:
            return
        try:
            with self.lock:
                self.states.take(message.name, message.position, message.velocity, message.effort)
        except ValueError as error:
            self.get_logger().warning(f"Ignored an invalid JointState message: {error}", throttle_duration_sec=5.0)

    def _tell(self) -> None:
        if self.states is None:
            return
        with self.lock:
            if self._delta > 0.0:
                self.states.step(self._delta)
            names, positions, velocities, efforts = self.states.told()
        if not names:
            return
        message = JointState(name=names, position=positions, velocity=velocities, effort=efforts)
        message.header.stamp = self.get_clock().now().to_msg()
        self._publisher.publish(message)

    def _dependent_joints(self) -> dict[str, tuple[str, float, float]]:
        """By joint: whom it follows, factor and offset."""
        found: dict[str, dict[str, Any]] = {}
        for name in self.get_parameters_by_prefix("dependent_joints"):
            joint, _, part = name.rpartition(".")
            if not joint or part not in {"parent", "factor", "offset"}:
                raise ValueError(
                    f"Invalid dependent_joint name '{name}': it is dependent_joints.JOINT.parent, .factor or .offset"
                )
            full = f"dependent_joints.{name}"
            found.setdefault(joint, {})[part] = (
                str(self.get_parameter(full).value) if part == "parent" else self._number(full)
            )
        for joint, parts in found.items():
            if "parent" not in parts:
                raise ValueError(f"All dependent_joints must at least have a parent: '{joint}' has none")
        return {
            joint: (parts["parent"], parts.get("factor", 1.0), parts.get("offset", 0.0))
            for joint, parts in found.items()
        }

    def _number(self, name: str) -> float:
        value = self.get_parameter(name).value
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise ValueError(f"parameter '{name}' must be a number, but is {value!r}")  # noqa: TRY004 - of the user
        return float(value)

    def _switch(self, name: str) -> bool:
        value = self.get_parameter(name).value
        if not isinstance(value, bool):
            raise ValueError(f"parameter '{name}' must be true or false, but is {value!r}")  # noqa: TRY004
        return value

    def _topics(self, name: str) -> list[str]:
        value = self.get_parameter(name).value
        if not isinstance(value, Sequence) or isinstance(value, str) or not all(isinstance(v, str) for v in value):
            raise ValueError(f"parameter '{name}' must be a list of topics, but is {value!r}")
        return list(value)


def run(args: list[str], robot: Robot | None = None, *, domain_id: int | None = None, **options: Any) -> None:
    """Run the node until it is ended from outside.

    Args:
        args: A command line; what follows `--ros-args` is the node's.
        robot: As of the node.
        domain_id: DDS domain; None: as the environment says.
        options: As of Node.

    Raises:
        RobotDescriptionError: As of the node, also for a description that arrives later.
        ValueError: As of the node.
    """
    spin_until_ended(lambda: JointStatePublisher(robot, **options), args, domain_id)


def main(args: list[str] | None = None) -> None:
    """The console script: maybe a file's name, then `--ros-args`."""
    program("joint_state_publisher", args, lambda words, files: run(words, load(files[0]) if files else None))
