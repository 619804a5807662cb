#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Broadcast the static transforms of the sensor mounts: camera, IMU and lidar.

Try it:
    static_tf_broadcaster --ros-args -p lidar_translation:="[0.0, 0.0, 0.6]"

Parameters (translations in meters, rotations as quaternions x, y, z, w):
    base_frame, end_effector_frame: the parent frames of the sensors
    camera_frame, camera_translation, camera_rotation: the mount of the camera on the end effector
    imu_frame, imu_translation, imu_rotation: the mount of the IMU on the base
    lidar_frame, lidar_translation, lidar_rotation: the mount of the lidar on the base
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
from tf2_ros import StaticTransformBroadcaster

NO_ROTATION = [0.0, 0.0, 0.0, 1.0]
# A rotation of 90 degrees about y: the z axis of the camera points along the gripper.
LOOK_FORWARD = [0.0, math.sqrt(0.5), 0.0, math.sqrt(0.5)]


class StaticFramePublisher(Node):
    """A node that publishes the static transforms of the sensors."""

    def __init__(self) -> None:
        super().__init__("static_tf_broadcaster")
        base = self.declare_parameter("base_frame", "base_link").value
        end_effector = self.declare_parameter("end_effector_frame", "end_effector").value

        # All transforms are sent in one call, because nodes that start later receive only the last message of Humble's
        # broadcaster.
        self.tf_broadcaster = StaticTransformBroadcaster(self)
        transforms = [
            self.make_mount("camera", end_effector, [0.05, 0.0, 0.02], LOOK_FORWARD),
            self.make_mount("imu", base, [0.0, 0.0, 0.1], NO_ROTATION),
            self.make_mount("lidar", base, [0.0, 0.0, 0.5], NO_ROTATION),
        ]
        self.tf_broadcaster.sendTransform(transforms)
        self.add_on_set_parameters_callback(self.reject_change)
        self.get_logger().info(f"Published {len(transforms)} static transforms")

    def reject_change(self, parameters: list[Any]) -> SetParametersResult:
        """Reject parameter changes, because the node reads its parameters only at startup."""
        for parameter in parameters:
            if parameter.name != "use_sim_time":
                reason = f"'{parameter.name}' is read when the node starts: restart the node to change it"
                return SetParametersResult(successful=False, reason=reason)
        return SetParametersResult(successful=True)

    def make_mount(self, sensor: str, parent: str, translation: list[float], rotation: list[float]) -> TransformStamped:
        """Create the transform of a sensor mount. The arguments are the defaults of its parameters."""
        translation = self.numbers(f"{sensor}_translation", translation)
        rotation = self.numbers(f"{sensor}_rotation", rotation)
        length = math.hypot(*rotation)
        if length == 0.0:
            raise ValueError(f"parameter '{sensor}_rotation' is not a valid quaternion: all four numbers are 0")

        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = parent
        t.child_frame_id = self.declare_parameter(f"{sensor}_frame", f"{sensor}_link").value
        t.transform.translation.x, t.transform.translation.y, t.transform.translation.z = translation
        t.transform.rotation.x = rotation[0] / length
        t.transform.rotation.y = rotation[1] / length
        t.transform.rotation.z = rotation[2] / length
        t.transform.rotation.w = rotation[3] / length
        return t

    def numbers(self, name: str, default: list[float]) -> list[float]:
        """Declare a parameter that is a list of finite numbers, with as many entries as its default."""
        values = [float(value) for value in self.declare_parameter(name, default).value]
        if len(values) != len(default) or not all(math.isfinite(value) for value in values):
            raise ValueError(f"parameter '{name}' must have {len(default)} finite numbers, but is {values}")
        return values


def main(args: list[str] | None = None) -> None:
    """Run the node until it is interrupted."""
    node = None
    try:
        rclpy.init(args=args)
        node = StaticFramePublisher()
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except (RuntimeError, NameValidationException, ParameterException, ValueError) as error:
        sys.exit(f"static_tf_broadcaster: {error}")
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
