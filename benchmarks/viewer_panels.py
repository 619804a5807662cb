# SPDX-License-Identifier: Apache-2.0
"""Measures what the panels next to the scene cost the viewer's server.

    python -m benchmarks.viewer_panels 5     seconds of each measurement: percent of one core

A robot in another process publishes transforms at 100 Hz, an IMU at 100 Hz, scans of 720 ranges at 20 Hz and log
messages at 10 Hz. A tab in a third process confirms each frame update. The program prints the processor time of the
viewer's process, including what it receives, for one step after the other: no panel, 8 curves, and then also the
inspector, the log, and the graph; at last, all panels are closed again.
"""

import json
import os
import subprocess
import sys
import time

import coframe

ENVIRONMENT = {**os.environ, "ROS_DOMAIN_ID": "38", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
WARM_UP = 3.0

ROBOT = """
import time, coframe
from coframe.messages import find
tf_type, stamped = find("tf2_msgs/msg/TFMessage"), find("geometry_msgs/msg/TransformStamped")
imu, scan, log = find("sensor_msgs/msg/Imu")(), find("sensor_msgs/msg/LaserScan")(), find("rcl_interfaces/msg/Log")()
scan.ranges = [float(i) for i in range(720)]
log.name, log.msg, log.level = "robot", "the robot is moving", 20
def stamp(header):
    header.stamp.sec, header.stamp.nanosec = divmod(time.time_ns(), 10**9)
with coframe.connect("robot") as ros:
    publishers = [ros.publisher(topic, type(one)) for topic, one in (("/imu", imu), ("/scan", scan), ("/rosout", log))]
    tf = ros.publisher("/tf", tf_type)
    for tick in range(10**9):
        transform = stamped(child_frame_id="base_link")
        transform.header.frame_id = "odom"
        stamp(transform.header)
        transform.transform.translation.x = tick % 100 / 100
        tf.publish(tf_type(transforms=[transform]))
        for publisher, one, every in zip(publishers, (imu, scan, log), (1, 5, 10)):
            if tick % every == 0:
                if one is not log:
                    stamp(one.header)
                publisher.publish(one)
        time.sleep(0.01)
"""

TAB = """
import sys, threading
from websockets.sync.client import connect
with connect(sys.argv[1].replace("http", "ws") + "ws", max_size=None, compression=None) as socket:
    threading.Thread(target=lambda: [socket.send(line) for line in sys.stdin], daemon=True).start()
    while True:
        message = socket.recv()
        if isinstance(message, bytes) and message[0] == 1:
            socket.send('{"type":"ready"}')
"""

CURVES = [f"odom:base_link.{quantity}" for quantity in ("x", "yaw", "distance", "delay")]
CURVES += ["/imu.linear_acceleration.x", "/imu.rate", "/scan.ranges[360]", "/scan.delay"]
CLOSED = ({"type": "curves", "curves": []}, {"type": "inspect", "topic": ""})
STEPS = (
    ("no panel", ()),
    (
        "8 curves",
        ({"type": "curves", "curves": [{"id": i, "expression": text} for i, text in enumerate(CURVES)]},),
    ),
    ("and the inspector", ({"type": "inspect", "topic": "/scan"},)),
    ("and the log", ({"type": "log", "shown": True},)),
    ("and the graph", ({"type": "graph", "shown": True},)),
    ("no panel again", (*CLOSED, {"type": "log", "shown": False}, {"type": "graph", "shown": False})),
)


def main(seconds: float) -> None:
    os.environ.update(ENVIRONMENT)
    robot = subprocess.Popen([sys.executable, "-c", ROBOT], env=ENVIRONMENT)
    try:
        with coframe.connect("coframe_view") as ros, coframe.show(ros, port=0) as viewer:
            tab = subprocess.Popen([sys.executable, "-c", TAB, viewer.url], stdin=subprocess.PIPE, text=True)
            assert tab.stdin
            for step, requests in STEPS:
                for request in requests:
                    print(json.dumps(request), file=tab.stdin, flush=True)
                time.sleep(WARM_UP)
                begin, cpu = time.monotonic(), time.process_time()
                time.sleep(seconds)
                share = (time.process_time() - cpu) / (time.monotonic() - begin)
                print(f"{step:20}{100 * share:5.1f} %", flush=True)
            tab.kill()
            tab.wait()
    finally:
        robot.kill()
        robot.wait()


if __name__ == "__main__":
    main(float(sys.argv[1]))
