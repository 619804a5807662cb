# SPDX-License-Identifier: Apache-2.0
"""Measures the time that `coframe view` takes until a tab receives its first frame update.

    python -m benchmarks.viewer_start

Prints two wall times in nanoseconds: until a tab receives a frame update of the ROS graph, and until the address was
printed, which is when a browser starts to load the page.
"""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

from websockets.sync.client import connect

ENVIRONMENT = {**os.environ, "ROS_DOMAIN_ID": "39", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
COMMAND = [str(Path(sys.executable).with_name("coframe")), "view", "--no-browser", "--port", "0"]


def main() -> None:
    begin = time.monotonic_ns()
    server = subprocess.Popen(COMMAND, stdout=subprocess.PIPE, text=True, env=ENVIRONMENT)
    assert server.stdout
    try:
        address = server.stdout.readline().strip()
        announced = time.monotonic_ns()
        with connect(address.replace("http", "ws") + "ws", max_size=None, compression=None) as tab:
            joined = False
            while True:
                message = tab.recv()
                if isinstance(message, bytes):
                    if joined:
                        break
                    tab.send('{"type":"ready"}')
                else:
                    content = json.loads(message)
                    joined |= content["type"] == "hello" and content["can_publish"]
        print(time.monotonic_ns() - begin, announced - begin)
    finally:
        server.terminate()
        server.wait()


if __name__ == "__main__":
    main()
