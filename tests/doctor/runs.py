# SPDX-License-Identifier: Apache-2.0
"""Recordings of a healthy robot, to which tests add faults."""

import numpy as np
from recordings import START, TF, humble, write_mcap
from rosbags.interfaces import Qos, QosHistory, QosLiveliness, QosReliability, QosTime
from rosbags.rosbag2 import Writer

from coframe import quaternion
from coframe.messages import find, serialize

SECOND = 1_000_000_000
MS = 1_000_000
SCAN = "sensor_msgs/msg/LaserScan"
STILL = (0.0, 0.0, 0.0, 1.0)

_Time = find("builtin_interfaces/msg/Time")
_Stamped = find("geometry_msgs/msg/TransformStamped")


def stamp_message(nanoseconds):
    return _Time(sec=nanoseconds // SECOND, nanosec=nanoseconds % SECOND)


def yaw(angle):
    return (0.0, 0.0, float(np.sin(angle / 2)), float(np.cos(angle / 2)))


def rpy(roll, pitch, yaw):
    return tuple(quaternion.from_rpy(np.array([roll, pitch, yaw])).tolist())


class Run:
    """Messages by topic, written as one MCAP file.

    ``healthy()`` returns a moving robot (odom -> base_link, 50 Hz) with a static lidar and its scans.
    """

    def __init__(self):
        self.rows = []
        self.types = {}

    @classmethod
    def healthy(cls, seconds=12, skip=(), latency=1 * MS, arrived=lambda at: at):
        run = cls()
        if "static" not in skip:
            run.tf("base_link", "lidar", START, (0.1, 0.0, 0.3), static=True)
        for i in range(seconds * 50):
            at = START + i * SECOND // 50
            if "odom" not in skip:
                run.drive(at, arrived=arrived(at) + latency)
            if i % 5 == 0 and "scan" not in skip:
                run.scan(at - 5 * MS, arrived=arrived(at) + latency)
        return run

    def drive(self, at, parent="odom", child="base_link", arrived=None, offset=0.0, stamp=None):
        seconds = (at - START) / SECOND
        place = (np.cos(seconds / 3) + offset, np.sin(seconds / 3), 0.0)
        self.tf(parent, child, at if stamp is None else stamp, place, yaw(seconds / 3), arrived=arrived or at + MS)

    def tf(self, parent, child, stamp, place=(0.0, 0.0, 0.0), turn=STILL, *, arrived=None, static=False, topic=None):
        message = _Stamped()
        message.header.stamp = stamp_message(stamp)
        message.header.frame_id, message.child_frame_id = parent, child
        t, q = message.transform.translation, message.transform.rotation
        t.x, t.y, t.z = map(float, place)
        q.x, q.y, q.z, q.w = map(float, turn)
        self.message(topic or ("/tf_static" if static else "/tf"), TF, find(TF)(transforms=[message]), arrived or stamp)

    def scan(self, stamp, frame="lidar", arrived=None, topic="/scan"):
        message = find(SCAN)()
        message.header.stamp, message.header.frame_id = stamp_message(stamp), frame
        self.message(topic, SCAN, message, arrived or stamp)

    def message(self, topic, type_, message, arrived):
        self.types[topic] = (type_, "ros2msg", b"", "cdr")
        self.rows.append((topic, int(arrived), serialize(message)))

    def write(self, folder):
        self.rows.sort(key=lambda row: row[1])
        return write_mcap(folder / "run.mcap", rows=self.rows, types=self.types)


class Offered:
    """A run as a rosbag2 recording with the QoS that the publishers of static transforms offered."""

    def __init__(self, run, plugin, *durabilities):
        self.run, self.plugin = run, plugin
        forever = QosTime(9223372036, 854775807)
        self.profiles = [
            Qos(QosHistory.KEEP_LAST, 1, QosReliability.RELIABLE, durability, forever, forever,
                QosLiveliness.AUTOMATIC, forever, avoid_ros_namespace_conventions=False)
            for durability in durabilities
        ]  # fmt: skip

    def write(self, folder):
        self.run.rows.sort(key=lambda row: row[1])
        with Writer(folder / "run", version=9, storage_plugin=self.plugin) as writer:
            connections = {
                topic: writer.add_connection(
                    topic, type_, typestore=humble, offered_qos_profiles=self.profiles if "static" in topic else []
                )
                for topic, (type_, *_) in self.run.types.items()
            }
            for topic, at, data in self.run.rows:
                writer.write(connections[topic], at, data)
        return folder / "run"
