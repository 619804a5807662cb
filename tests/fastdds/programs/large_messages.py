# SPDX-License-Identifier: Apache-2.0
"""Print the checksums of the clouds that another process publishes: large_messages.py SIZE COUNT."""

import subprocess
import sys
import time
import zlib

import coframe
from coframe.messages import find

CLOUD = find("sensor_msgs/msg/PointCloud2")
TOPIC = "/points"


def publish(size: int, count: int) -> None:
    with coframe.connect("publisher") as ros:
        publisher = ros.publisher(TOPIC, CLOUD)
        while not publisher.matched:
            time.sleep(0.01)
        for number in range(count):
            publisher.publish(CLOUD(width=number, data=bytes((number,)) * size))
            sys.stdin.readline()


def receive(size: int, count: int) -> None:
    with coframe.connect("receiver") as ros:
        subscription = ros.subscribe(TOPIC, CLOUD)
        command = [sys.executable, __file__, str(size), str(count), "publish"]
        with subprocess.Popen(command, stdin=subprocess.PIPE, text=True) as other:
            assert other.stdin
            for number in range(count):
                message = subscription.receive("30s")
                assert message is not None
                assert message.width == number
                print(zlib.crc32(message.data), flush=True)
                other.stdin.write("\n")
                other.stdin.flush()


if __name__ == "__main__":
    (publish if sys.argv[-1] == "publish" else receive)(int(sys.argv[1]), int(sys.argv[2]))
