#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Publish the scans of a simulated lidar in a long hall with pillars, at the position of the robot.

The hall is infinite along x, because the robot keeps driving. It contains all kinds of invalid ranges: far away
there is no echo (infinity, see REP 117), a pane of glass gives 0, which is below the minimum range, and a mirror gives
a range above the maximum.

Try it:
    simulated_lidar --ros-args -p rate:=5.0

Parameters:
    rate: the rate of the scans, in Hz
    beams: the number of beams in a scan
    range_min, range_max: the minimum and maximum range, in meters
    frame: the frame of the lidar
    fixed_frame: the frame of the hall; the lidar is at its origin until its transform is available
    scan_topic: the topic of the scans
"""

import math
import sys
from array import array
from typing import Any

import numpy as np
from numpy.typing import NDArray

import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.exceptions import NameValidationException, ParameterException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from tf2_ros import Buffer, TransformException, TransformListener

Array = NDArray[np.float64]

HALL_START = -4.0  # the x coordinate of the wall behind the robot
HALL_HALF_WIDTH = 3.0  # the side walls are at y = -3 and y = 3
PILLAR_SPACING = 4.0
PILLAR_OFFSET = 1.8  # the pillars are alternately on the left and on the right side
PILLAR_RADIUS = 0.25
WALL_INTENSITY = 100.0
PILLAR_INTENSITY = 200.0
# The part of the side walls, as a fraction of the pillar spacing, that is glass on the right and a mirror on the left.
REFLECTIVE_PART = 0.1


class SimulatedLidar(Node):
    """A node that publishes laser scans of a simulated hall."""

    def __init__(self) -> None:
        super().__init__("simulated_lidar")
        rate = self.declare_parameter("rate", 10.0).value
        if not rate > 0.0:
            raise ValueError(f"parameter 'rate' must be greater than 0 Hz, but is {rate}")
        self.period = 1.0 / rate
        self.beams = self.declare_parameter("beams", 360).value
        if self.beams < 1:
            raise ValueError(f"parameter 'beams' must be at least 1, but is {self.beams}")
        self.range_min = self.declare_parameter("range_min", 0.1).value
        self.range_max = self.declare_parameter("range_max", 10.0).value
        self.frame = self.declare_parameter("frame", "lidar_link").value
        self.fixed_frame = self.declare_parameter("fixed_frame", "odom").value

        self.tf_buffer = Buffer()
        self.tf_listener = TransformListener(self.tf_buffer, self)
        topic = self.declare_parameter("scan_topic", "/scan").value
        self.scan_pub = self.create_publisher(LaserScan, topic, 10)
        self.timer = self.create_timer(self.period, self.publish_scan)
        self.add_on_set_parameters_callback(self.change_parameters)
        self.get_logger().info("Simulated lidar started")

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

    def publish_scan(self) -> None:
        """Publish a scan from the current pose of the lidar."""
        increment = 2.0 * math.pi / self.beams
        angles = -math.pi + increment * np.arange(self.beams)
        x, y, yaw = self.lidar_pose()
        ranges, intensities = measure(x, y, angles + yaw, self.range_max)

        scan = LaserScan()
        scan.header.stamp = self.get_clock().now().to_msg()
        scan.header.frame_id = self.frame
        scan.angle_min = -math.pi
        scan.angle_max = float(angles[-1])
        scan.angle_increment = increment
        scan.time_increment = 0.0  # all beams are measured at the same time
        scan.scan_time = self.period
        scan.range_min = self.range_min
        scan.range_max = self.range_max
        scan.ranges = array("f", ranges.astype(np.float32).tobytes())
        scan.intensities = array("f", intensities.astype(np.float32).tobytes())
        self.scan_pub.publish(scan)

    def lidar_pose(self) -> tuple[float, float, float]:
        """Return the pose of the lidar in the hall as x, y and yaw, or the origin if its transform is not available."""
        try:
            transform = self.tf_buffer.lookup_transform(self.fixed_frame, self.frame, Time()).transform
        except TransformException as e:
            self.get_logger().info(
                f"The lidar stays at the origin until there is a transform to it: {e}", throttle_duration_sec=10.0
            )
            return 0.0, 0.0, 0.0
        q = transform.rotation
        yaw = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
        return transform.translation.x, transform.translation.y, yaw


def measure(x: float, y: float, headings: Array, range_max: float) -> tuple[Array, Array]:
    """Simulate the measurement of a lidar in the hall.

    Args:
        x: The position along the hall, in meters.
        y: The position across the hall, in meters.
        headings: The directions of the beams in the hall, in radians, (N,).
        range_max: The maximum range, in meters.

    Returns:
        The ranges and the intensities, (N,) each.
    """
    dx, dy = np.cos(headings), np.sin(headings)
    left = distance_to_wall(HALL_HALF_WIDTH - y, dy)
    right = distance_to_wall(-HALL_HALF_WIDTH - y, dy)
    walls = np.minimum(np.minimum(left, right), distance_to_wall(HALL_START - x, dx))
    pillars = distance_to_pillars(x, y, dx, dy, range_max)

    ranges = np.minimum(walls, pillars)
    intensities = np.where(pillars < walls, PILLAR_INTENSITY, WALL_INTENSITY)
    lost = ranges > range_max
    ranges[lost] = np.inf

    hit_x = x + np.where(lost, 0.0, ranges) * dx
    is_reflective = ~lost & (np.mod(hit_x / PILLAR_SPACING, 1.0) < REFLECTIVE_PART)
    mirror, glass = is_reflective & (ranges == left), is_reflective & (ranges == right)
    ranges[mirror] = range_max + 1.0
    ranges[glass] = 0.0
    intensities[lost | glass] = 0.0
    return ranges, intensities


def distance_to_wall(offset: float, direction: Array) -> Array:
    """Return the distances to a wall at an offset along one axis, for beams with these components along the axis."""
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = offset / direction
    return np.where(distance > 0.0, distance, np.inf)


def distance_to_pillars(x: float, y: float, dx: Array, dy: Array, range_max: float) -> Array:
    """Return the distances along the beams to the nearest pillar within range; infinity if there is none."""
    nearest = np.full(len(dx), np.inf)
    first = math.ceil((x - range_max) / PILLAR_SPACING)
    last = math.floor((x + range_max) / PILLAR_SPACING)
    for number in range(first, last + 1):
        pillar_x = number * PILLAR_SPACING
        if pillar_x < HALL_START:
            continue
        to_x = pillar_x - x
        to_y = (PILLAR_OFFSET if number % 2 == 0 else -PILLAR_OFFSET) - y
        along = to_x * dx + to_y * dy
        half_chord_squared = PILLAR_RADIUS**2 - (to_x**2 + to_y**2 - along**2)
        entry = along - np.sqrt(np.maximum(half_chord_squared, 0.0))
        nearest = np.where((half_chord_squared >= 0.0) & (entry > 0.0), np.minimum(nearest, entry), nearest)
    return nearest


def main(args: list[str] | None = None) -> None:
    """Run the node until it is interrupted."""
    node = None
    try:
        rclpy.init(args=args)
        node = SimulatedLidar()
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except (RuntimeError, NameValidationException, ParameterException, ValueError) as error:
        sys.exit(f"simulated_lidar: {error}")
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
