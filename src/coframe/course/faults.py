# SPDX-License-Identifier: Apache-2.0
"""Ten deliberately broken systems, each with one fault for students to find."""

from __future__ import annotations

from typing import NamedTuple

from coframe.course.running import NamedCommand, module_program

__all__ = ["FAULTS", "Fault"]


class Fault(NamedTuple):
    """A deliberately broken system to diagnose.

    Attributes:
        name: The name of the fault, which is the answer.
        explanation: The cause of the fault, and how to find it.
        programs: The programs of the system.
    """

    name: str
    explanation: str
    programs: tuple[NamedCommand, ...]


def _node(name: str, *parameters: str, title: str = "") -> NamedCommand:
    words = [word for parameter in parameters for word in ("-p", parameter)]
    title = title or name
    remap = ("-r", f"__node:={title}") if title != name else ()
    arguments = ("--ros-args", *remap, *words) if words or remap else ()
    return module_program(title, f"coframe.lab.{name}", *arguments)


def _node_with_fault(fault: str, name: str) -> NamedCommand:
    """Return a node of the lab with a fault from coframe.course._faulty_node."""
    return module_program(name, "coframe.course._faulty_node", fault, name)


_STATIC, _DYNAMIC = _node("static_tf_broadcaster"), _node("dynamic_tf_broadcaster")
_LISTENER, _SENSOR = _node("tf_listener"), _node("sensor_transform")
_LIDAR = _node("simulated_lidar", "fixed_frame:=base_link")
_DESCRIPTION = module_program("robot_description", "coframe.course._description")  # the doctor compares with it
_JOINTS = _node("dynamic_tf_broadcaster", "publish_joint_states:=true", title="joint_driver")
_SQRT_HALF = 0.5**0.5

FAULTS = (
    Fault(
        "late broadcaster",
        "The sensor mounts are published 20 s after everything else. Until then, every scan is dropped.",
        (_node_with_fault("late", "static_tf_broadcaster"), _DYNAMIC, _LISTENER, _LIDAR, _SENSOR),
    ),
    Fault(
        "misspelled frame",
        "The lidar is mounted as 'lidar_lnik', but its scans are in 'lidar_link'.",
        (_node("static_tf_broadcaster", "lidar_frame:=lidar_lnik"), _DYNAMIC, _LISTENER, _LIDAR, _SENSOR),
    ),
    Fault(
        "clock offset",
        "The stamps of the arm are 5 s behind the clock, as if the clock of its computer were wrong.",
        (_STATIC, _node_with_fault("offset", "dynamic_tf_broadcaster"), _LISTENER, _LIDAR, _SENSOR),
    ),
    Fault(
        "missing static transform",
        "No node publishes the sensor mounts, so the lidar is not connected to the robot.",
        (_DYNAMIC, _LISTENER, _LIDAR, _SENSOR),
    ),
    Fault(
        "second publisher",
        "Two nodes publish the arm with different lengths: it flickers between two poses.",
        (
            _STATIC,
            _DYNAMIC,
            _node("dynamic_tf_broadcaster", "link_lengths:=[0.3, 0.6]", title="arm_driver"),
            _LISTENER,
            _LIDAR,
            _SENSOR,
        ),
    ),
    Fault(
        "dropout",
        "The arm is not published for 1 s in every 4 s.",
        (_STATIC, _node_with_fault("dropout", "dynamic_tf_broadcaster"), _LISTENER, _LIDAR, _SENSOR),
    ),
    Fault(
        "swapped quaternion order",
        "The rotation of the camera is in the order w, x, y, z instead of x, y, z, w.",
        (
            _DESCRIPTION,
            _node("static_tf_broadcaster", f"camera_rotation:=[{_SQRT_HALF}, 0.0, {_SQRT_HALF}, 0.0]"),
            _DYNAMIC,
            _LISTENER,
            _LIDAR,
            _SENSOR,
        ),
    ),
    Fault(
        "degrees",
        "The joint angles are in degrees, but are used as radians: the arm turns around several times.",
        (
            _DESCRIPTION,
            _JOINTS,
            _STATIC,
            _node_with_fault("degrees", "dynamic_tf_broadcaster"),
            _LISTENER,
            _LIDAR,
            _SENSOR,
        ),
    ),
    Fault(
        "wrong parent",
        "The second link is mounted on base_link instead of link1.",
        (_DESCRIPTION, _STATIC, _node_with_fault("wrong parent", "dynamic_tf_broadcaster"), _LISTENER, _LIDAR, _SENSOR),
    ),
    Fault(
        "dead listener",
        "The listener runs, but its first failed lookup has ended its timer: /end_effector_pose has no messages.",
        (_STATIC, _DYNAMIC, _node_with_fault("dead", "tf_listener"), _LIDAR, _SENSOR),
    ),
)
