# SPDX-License-Identifier: Apache-2.0
"""The nodes of coframe in processes: every scan becomes a correct cloud at its own stamp while the robot moves."""

import bisect
import signal

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

TOPICS = (
    "/scan:sensor_msgs/msg/LaserScan:volatile",
    "/scan_base_frame:sensor_msgs/msg/PointCloud2:volatile",
    "/tf:tf2_msgs/msg/TFMessage:volatile",
    "/tf_static:tf2_msgs/msg/TFMessage:transient_local",
    "/end_effector_pose:geometry_msgs/msg/PoseStamped:volatile",
)
NODES = {
    "complete_tf_tree": ["--ros-args", "-p", "publish_arm:=false"],
    "dynamic_tf_broadcaster": [],
    "tf_listener": [],
    "simulated_lidar": [],
    # The lidar does not move relative to base_link. Relative to odom, it moves with the base.
    "sensor_transform": ["--ros-args", "-p", "target_frame:=odom"],
}


def nanoseconds(message):
    stamp = message["header"]["stamp"]
    return stamp["sec"] * 10**9 + stamp["nanosec"]


class Tree:
    """The transforms received on /tf and /tf_static, composed with SciPy."""

    def __init__(self, received):
        self.links = {}
        for topic in ("/tf", "/tf_static"):
            for _, message in received[topic]:
                for transform in message["transforms"]:
                    parent, child = transform["header"]["frame_id"], transform["child_frame_id"]
                    t, r = transform["transform"]["translation"], transform["transform"]["rotation"]
                    values = [t["x"], t["y"], t["z"], r["x"], r["y"], r["z"], r["w"]]
                    _, _, samples = self.links.setdefault(child, (parent, topic == "/tf_static", {}))
                    samples[nanoseconds(transform)] = values
        self.links = {c: (p, static, sorted(samples.items())) for c, (p, static, samples) in self.links.items()}

    def matrix(self, child, stamp):
        _, static, samples = self.links[child]
        if static:
            values = np.array(samples[-1][1])
        else:
            i = bisect.bisect_left([s for s, _ in samples], stamp)
            assert 0 < i < len(samples), "the scan's time must lie within what was received"
            (start, a), (end, b) = samples[i - 1], samples[i]
            share = (stamp - start) / (end - start)
            rotation = Slerp([0, 1], Rotation.from_quat([a[3:], b[3:]]))(share).as_quat()
            values = np.concatenate([(1 - share) * np.array(a[:3]) + share * np.array(b[:3]), rotation])
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = Rotation.from_quat(values[3:]).as_matrix(), values[:3]
        return matrix

    def lookup(self, ancestor, frame, stamp):
        matrix = np.eye(4)
        while frame != ancestor:
            matrix = self.matrix(frame, stamp) @ matrix
            frame = self.links[frame][0]
        return matrix


def expected_points(scan, tree):
    ranges = np.array(scan["ranges"], dtype=np.float64)
    angles = scan["angle_min"] + np.arange(len(ranges)) * scan["angle_increment"]
    valid = np.isfinite(ranges) & (ranges >= scan["range_min"]) & (ranges <= scan["range_max"])
    ranges, angles = ranges[valid], angles[valid]
    points = np.stack([ranges * np.cos(angles), ranges * np.sin(angles), 0 * ranges, 1 + 0 * ranges])
    return (tree.lookup("odom", scan["header"]["frame_id"], nanoseconds(scan)) @ points)[:3].T


@pytest.mark.timeout(120)
def by_stamp(received):
    """Return the tree, and the scans and clouds by stamp."""
    tree = Tree(received)
    moving = [samples for _, static, samples in tree.links.values() if not static]
    clouds = {nanoseconds(cloud): cloud for _, cloud in received["/scan_base_frame"]}
    if not moving or not clouds:
        return tree, {}, clouds
    first, last = max(s[0][0] for s in moving), min(s[-1][0] for s in moving)
    scans = {nanoseconds(scan): scan for _, scan in received["/scan"] if first < nanoseconds(scan) < last - 500_000_000}
    # Some scans arrive before the first cloud. From then on, every scan must have a cloud.
    return tree, {stamp: scan for stamp, scan in scans.items() if stamp >= min(clouds)}, clouds


def test_every_scan_is_published_as_a_correct_cloud(processes):
    for name, arguments in NODES.items():
        processes.start(name, "python", "-m", f"coframe.lab.{name}", *arguments)
    for seconds in (6.0, 15.0, 30.0):  # a busy machine needs more time
        received = processes.observe(seconds, *TOPICS)
        tree, scans, clouds = by_stamp(received)
        if len(scans) >= 40 and set(scans) <= set(clouds):  # which may also find no transform in time
            break
    assert len(scans) >= 40
    assert set(scans) <= set(clouds), "some scans became no cloud"

    positions = []
    for stamp, scan in scans.items():
        cloud = clouds[stamp]
        assert cloud["header"]["frame_id"] == "odom"
        assert [field["name"] for field in cloud["fields"]] == ["x", "y", "z", "intensity"]
        values = np.frombuffer(bytes(cloud["data"]), dtype="<f4").reshape(-1, 4)
        expected = expected_points(scan, tree)
        assert 100 < len(values) == len(expected) < len(scan["ranges"])
        np.testing.assert_allclose(values[:, :3], expected, rtol=0, atol=1e-6)
        positions.append(tree.lookup("odom", "base_link", stamp)[:3, 3])
    assert np.ptp(positions, axis=0)[0] > 0.2, "the base must have moved"
    assert np.ptp([p["pose"]["position"]["y"] for _, p in received["/end_effector_pose"]]) > 0.1, "so must the arm"

    for name in NODES:
        code, text = processes.end(name, signal.SIGINT)
        assert code == 0, text
        assert "Traceback" not in text
