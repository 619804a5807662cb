# SPDX-License-Identifier: Apache-2.0
"""The service that tf2's view_frames calls, called from another process."""

import json

import pytest

yaml = pytest.importorskip("yaml")

HOLDER = """
import rclpy, tf2_ros
rclpy.init()
node = rclpy.create_node("holder")
buffer = tf2_ros.Buffer(node=node)
listener = tf2_ros.TransformListener(buffer, node, spin_thread=False)
rclpy.spin(node)
"""
ASKER = """
import json, time
import rclpy, yaml
from tf2_msgs.srv import FrameGraph
rclpy.init()
node = rclpy.create_node("view_frames")
client = node.create_client(FrameGraph, "tf2_frames")
while not client.wait_for_service(timeout_sec=1.0):
    print("service not available, waiting again...", flush=True)
frames, deadline = {}, time.monotonic() + 30
while (len(frames) < 10 or frames["link1"]["rate"] > 60) and time.monotonic() < deadline:
    future = client.call_async(FrameGraph.Request())
    rclpy.spin_until_future_complete(node, future)
    text = future.result().frame_yaml
    frames = yaml.safe_load(text) or {}
print("FRAMES", json.dumps(text), flush=True)
"""


@pytest.mark.slow
def test_another_process_receives_all_frames_as_yaml(processes, eventually):
    processes.start("tree", "python", "-m", "coframe.lab.complete_tf_tree")
    processes.start("holder", "python", "-c", HOLDER)
    processes.start("asker", "python", "-c", ASKER)
    eventually(lambda: "FRAMES" in processes.text("asker"))
    data = yaml.safe_load(json.loads(processes.text("asker").partition("FRAMES ")[2]))
    assert data["link1"]["parent"] == "base_link"
    assert 40 < data["link1"]["rate"] < 60
    assert data["lidar_link"]["oldest_transform"] == 0.0
    # The text from which view_frames makes a label.
    keys = {"parent", "broadcaster", "rate", "most_recent_transform", "oldest_transform", "buffer_length"}
    assert all(keys <= set(frame) for frame in data.values())
    (root,) = {frame["parent"] for frame in data.values()} - set(data)
    assert root == "world"
