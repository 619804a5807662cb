# SPDX-License-Identifier: Apache-2.0
"""The class JointStatePublisher with the attributes and methods that upstream's graphical interface uses."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, MutableMapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe.nodes import joint_state_publisher as node
from coframe.nodes.joint_state_publisher import main
from coframe.robots import Robot, RobotDescriptionError, load, parse_urdf
from coframe.robots.joint_states import FreeJoint, JointStates

if TYPE_CHECKING:
    from sensor_msgs.msg import JointState
    from std_msgs.msg import String

__all__ = ["JointStatePublisher", "JointValues", "main"]

_ATTRIBUTES = {
    "min": "lower",
    "max": "upper",
    "zero": "zero",
    "continuous": "continuous",
    "forward": "increasing",
    "position": "position",
    "velocity": "velocity",
    "effort": "effort",
}

Joints = tuple[dict[str, "JointValues"], list[str], dict[str, dict[str, Any]]]


class JointValues(MutableMapping[str, Any]):
    """The values of a joint as upstream's dictionary: min, max, zero, position, velocity, effort, ...

    Args:
        joint: The joint, to which values are written. Values that are None are not in the dictionary.
    """

    def __init__(self, joint: FreeJoint) -> None:
        self._joint = joint

    def __getitem__(self, key: str) -> Any:
        value = getattr(self._joint, _ATTRIBUTES[key])
        if value is None:
            raise KeyError(key)
        return value

    def __setitem__(self, key: str, value: Any) -> None:
        setattr(self._joint, _ATTRIBUTES[key], value)

    def __delitem__(self, key: str) -> None:
        setattr(self._joint, _ATTRIBUTES[key], None)

    def __iter__(self) -> Iterator[str]:
        return (key for key, attribute in _ATTRIBUTES.items() if getattr(self._joint, attribute) is not None)

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __repr__(self) -> str:
        return repr(dict(self))


class JointStatePublisher(node.JointStatePublisher):
    """Node that publishes the states of the joints of a robot periodically.

    Args:
        description: File of the robot description, or the robot. None: the description is received on
            `/robot_description`.
        options: Keyword arguments of Node.

    Attributes:
        free_joints: Values of the joints that do not follow others; changes are published.
        joint_list: Names of all joints, in the order of the description.
        dependent_joints: Parent, factor and offset of the joints that follow others.

    Raises:
        RobotDescriptionError: The description is not valid.
        ValueError: A parameter is not valid.
    """

    def __init__(self, description: str | os.PathLike[str] | Robot | None = None, **options: Any) -> None:
        self.free_joints: dict[str, JointValues] = {}
        self.joint_list: list[str] = []
        self.dependent_joints: dict[str, dict[str, Any]] = {}
        self.__on_source: Callable[[], Any] | None = None
        self.__on_robot: Callable[[], Any] | None = None
        robot = load(Path(description)) if isinstance(description, (str, os.PathLike)) else description
        super().__init__(robot, **options)

    def configure(self, robot: Robot) -> None:
        """Use this robot with its default joint positions.

        Raises:
            RobotDescriptionError: Mimic joints form a cycle or refer to a joint that does not exist.
        """
        super().configure(robot)
        assert self.states is not None
        self.free_joints, self.joint_list, self.dependent_joints = self.__joints(robot, self.states)
        if self.__on_robot is not None:
            self.__on_robot()

    def configure_robot(self, description: str) -> None:
        """Use the robot of a description.

        Args:
            description: The text of a URDF.

        Raises:
            RobotDescriptionError: The description is not valid.
        """
        self.configure(parse_urdf(description))

    def init_urdf(self, robot: Any) -> Joints:
        """Return `free_joints`, `joint_list` and `dependent_joints` of a description, without using it.

        Args:
            robot: The description as a document of `xml.dom.minidom`.

        Raises:
            RobotDescriptionError: The description is not valid.
        """
        parsed = parse_urdf(robot.toxml())
        return self.__joints(parsed, JointStates(parsed, **self._chosen_parameters))

    def init_collada(self, robot: Any) -> Joints:
        """Raise an error, because descriptions in COLLADA are not supported.

        Raises:
            RobotDescriptionError: Always.
        """
        raise RobotDescriptionError(f"The robot description {robot!r} is COLLADA, which coframe does not read.")

    def parse_dependent_joints(self) -> dict[str, dict[str, Any]]:
        """Return parent, factor and offset of the joints in the parameters `dependent_joints`.

        Raises:
            ValueError: A parameter is not valid.
        """
        rules = self._dependent_joints().items()
        return {name: dict(zip(("parent", "factor", "offset"), rule, strict=True)) for name, rule in rules}

    def get_param(self, name: str) -> Any:
        """Return the value of a parameter."""
        return self.get_parameter(name).value

    def source_cb(self, msg: JointState) -> None:
        """Use the values of a message from another source."""
        self._on_source(msg)

    def robot_description_cb(self, msg: String) -> None:
        """Use the robot description in a message."""
        self._on_description(msg)

    def set_source_update_cb(self, user_cb: Callable[[], Any]) -> None:
        """Set the function that is called when another source has set values."""
        self.__on_source = user_cb

    def set_robot_description_update_cb(self, user_cb: Callable[[], Any]) -> None:
        """Set the function that is called when another robot is used."""
        self.__on_robot = user_cb

    def update(self, delta: float) -> None:
        """Move all free joints by an angle or a distance, back and forth between their limits."""
        with self.lock:
            if self.states is not None:
                self.states.step(delta)

    def _on_source(self, message: JointState) -> None:
        super()._on_source(message)
        if self.__on_source is not None:
            self.__on_source()

    def __joints(self, robot: Robot, states: JointStates) -> Joints:
        dependent = self.parse_dependent_joints()
        if self.get_param("use_mimic_tags"):
            for name, joint in robot.joints.items():
                tag = joint.mimic
                if tag is not None:
                    rule = {"parent": tag.joint, "factor": tag.multiplier, "offset": tag.offset}
                    dependent.setdefault(name, rule)
        return {name: JointValues(joint) for name, joint in states.free.items()}, states.fields().names, dependent
