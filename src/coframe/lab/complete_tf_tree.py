#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Publish the complete transform tree of the robot system: world, map, odom, base, arm and sensors.

Try it:
    complete_tf_tree --ros-args -p publish_arm:=false      # dynamic_tf_broadcaster publishes the arm

Parameters:
    rate: the rate of the dynamic transforms, in Hz
    publish_world: whether to publish world -> map (false if another robot publishes it)
    start_x, start_y, start_yaw: the initial pose of odom relative to map, in meters and radians
    publish_base: whether to publish map -> odom -> base_link (false if a real or simulated robot publishes them)
    publish_arm: whether to publish the transforms of the arm (false if dynamic_tf_broadcaster publishes them)
    publish_mounts: whether to publish the sensor mounts (false if static_tf_broadcaster publishes them)
    publish_gripper: whether to publish the gripper mount (false if robot_state_publisher publishes it)
    link_lengths, base_height: the dimensions of the arm, in meters
    world_frame, map_frame, odom_frame, base_frame, link1_frame, link2_frame, end_effector_frame: the frame names
    imu_frame, lidar_frame, camera_frame, gripper_frame: the frame names of the mounts
    imu_translation, lidar_translation, camera_translation, gripper_translation: the positions of the mounts relative
        to their parent frames, in meters
"""

import math
import sys
from collections.abc import Sequence
from typing import Any

import rclpy
from builtin_interfaces.msg import Time
from geometry_msgs.msg import TransformStamped
from rcl_interfaces.msg import SetParametersResult
from rclpy.exceptions import NameValidationException, ParameterException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.time import Time as ClockTime
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

FRAMES = {
    "world": "world",
    "map": "map",
    "odom": "odom",
    "base": "base_link",
    "link1": "link1",
    "link2": "link2",
    "end_effector": "end_effector",
    "imu": "imu_link",
    "lidar": "lidar_link",
    "camera": "camera_link",
    "gripper": "gripper_link",
}
NO_TRANSLATION = [0.0, 0.0, 0.0]
NO_ROTATION = [0.0, 0.0, 0.0, 1.0]
# A rotation of 90 degrees about y: the z axis of the camera points along the gripper.
LOOK_FORWARD = [0.0, math.sqrt(0.5), 0.0, math.sqrt(0.5)]


class CompleteTFTree(Node):
    """A node that publishes the static and dynamic transforms of the complete robot system."""

    def __init__(self) -> None:
        super().__init__("complete_tf_tree")
        rate = self.declare_parameter("rate", 50.0).value
        if not rate > 0.0:
            raise ValueError(f"parameter 'rate' must be greater than 0 Hz, but is {rate}")
        self.period = 1.0 / rate
        self.frames = {
            frame: self.declare_parameter(f"{frame}_frame", default).value for frame, default in FRAMES.items()
        }
        self.publish_world = self.declare_parameter("publish_world", True).value
        self.start = [float(self.declare_parameter(f"start_{part}", 0.0).value) for part in ("x", "y", "yaw")]
        self.publish_base = self.declare_parameter("publish_base", True).value
        self.publish_arm = self.declare_parameter("publish_arm", True).value
        self.publish_mounts = self.declare_parameter("publish_mounts", True).value
        self.publish_gripper = self.declare_parameter("publish_gripper", True).value
        self.link_lengths = self.lengths("link_lengths", [0.4, 0.3])
        self.base_height = self.declare_parameter("base_height", 0.2).value

        self.static_broadcaster = StaticTransformBroadcaster(self)
        self.dynamic_broadcaster = TransformBroadcaster(self)
        self.publish_static_transforms()

        self.timer = self.create_timer(self.period, self.publish_dynamic_transforms)
        self.sim_time = 0.0
        self.last_tick: ClockTime | None = None
        self.add_on_set_parameters_callback(self.change_parameters)
        self.get_logger().info("Complete TF tree manager started")

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

    def lengths(self, name: str, default: list[float]) -> list[float]:
        """Declare a parameter that is a list of lengths, with as many entries as its default."""
        values = [float(value) for value in self.declare_parameter(name, default).value]
        if len(values) != len(default) or not all(math.isfinite(value) for value in values):
            raise ValueError(f"parameter '{name}' must have {len(default)} finite numbers, but is {values}")
        return values

    def publish_static_transforms(self) -> None:
        """Publish all static transforms."""
        imu = self.lengths("imu_translation", [0.0, 0.0, 0.1])
        lidar = self.lengths("lidar_translation", [0.1, 0.0, 0.3])
        camera = self.lengths("camera_translation", [0.05, 0.0, 0.02])
        gripper = self.lengths("gripper_translation", [0.1, 0.0, 0.0])

        static_tfs = []
        if self.publish_world:
            # The transform world -> map is the identity in this simulation.
            static_tfs.append(self.make_transform("world", "map", NO_TRANSLATION, NO_ROTATION))
        if self.publish_mounts:
            static_tfs += [
                self.make_transform("base", "imu", imu, NO_ROTATION),
                self.make_transform("base", "lidar", lidar, NO_ROTATION),
                self.make_transform("end_effector", "camera", camera, LOOK_FORWARD),
            ]
        if self.publish_gripper:
            static_tfs.append(self.make_transform("end_effector", "gripper", gripper, NO_ROTATION))

        self.static_broadcaster.sendTransform(static_tfs)
        self.get_logger().info(f"Published {len(static_tfs)} static transforms")

    def publish_dynamic_transforms(self) -> None:
        """Publish all dynamic transforms in one message, so that listeners always receive a consistent robot."""
        now = self.get_clock().now()
        self.advance(now)
        stamp = now.to_msg()
        dynamic_tfs = []
        if self.publish_base:
            dynamic_tfs += self.base_transforms(stamp)
        if self.publish_arm:
            dynamic_tfs += self.arm_transforms(stamp)
        if dynamic_tfs:
            self.dynamic_broadcaster.sendTransform(dynamic_tfs)

    def advance(self, now: ClockTime) -> None:
        """Advance the simulated time by the time between two stamps. If the clock jumps back, advance by one period."""
        elapsed = self.period if self.last_tick is None else (now - self.last_tick).nanoseconds * 1e-9
        self.last_tick = now
        self.sim_time += self.period if elapsed < 0.0 else elapsed

    def base_transforms(self, stamp: Time) -> list[TransformStamped]:
        """Return the transforms of the base: it drives forward and sways slightly, and the localization drifts."""
        start_x, start_y, start_yaw = self.start
        drift = 0.001 * self.sim_time
        x = 0.1 * self.sim_time
        y = 0.05 * math.sin(0.5 * self.sim_time)
        yaw = 0.1 * math.sin(0.2 * self.sim_time)
        return [
            self.make_transform(
                "map", "odom", [start_x + drift, start_y + drift / 2, 0.0], self.yaw_to_quat(start_yaw), stamp
            ),
            self.make_transform("odom", "base", [x, y, 0.0], self.yaw_to_quat(yaw), stamp),
        ]

    def arm_transforms(self, stamp: Time) -> list[TransformStamped]:
        """Return the transforms of the arm, whose two joints swing."""
        q1 = 0.5 * math.sin(0.3 * self.sim_time)
        q2 = 0.3 * math.sin(0.4 * self.sim_time + 0.5)
        first, second = self.link_lengths
        return [
            self.make_transform("base", "link1", [0.0, 0.0, self.base_height], self.yaw_to_quat(q1), stamp),
            self.make_transform("link1", "link2", [first, 0.0, 0.0], self.yaw_to_quat(q2), stamp),
            self.make_transform("link2", "end_effector", [second, 0.0, 0.0], NO_ROTATION, stamp),
        ]

    def make_transform(
        self,
        parent: str,
        child: str,
        translation: Sequence[float],
        rotation: Sequence[float],
        stamp: Time | None = None,
    ) -> TransformStamped:
        """Create the transform between two of FRAMES. The default stamp is the current time."""
        t = TransformStamped()
        t.header.stamp = stamp if stamp is not None else self.get_clock().now().to_msg()
        t.header.frame_id = self.frames[parent]
        t.child_frame_id = self.frames[child]
        t.transform.translation.x = float(translation[0])
        t.transform.translation.y = float(translation[1])
        t.transform.translation.z = float(translation[2])
        t.transform.rotation.x = float(rotation[0])
        t.transform.rotation.y = float(rotation[1])
        t.transform.rotation.z = float(rotation[2])
        t.transform.rotation.w = float(rotation[3])
        return t

    @staticmethod
    def yaw_to_quat(yaw: float) -> list[float]:
        """Convert a yaw angle to a quaternion [x, y, z, w]."""
        return [0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)]


def main(args: list[str] | None = None) -> None:
    """Run the node until it is interrupted."""
    node = None
    try:
        rclpy.init(args=args)
        node = CompleteTFTree()
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except (RuntimeError, NameValidationException, ParameterException, ValueError) as error:
        sys.exit(f"complete_tf_tree: {error}")
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
