# SPDX-License-Identifier: Apache-2.0
"""Publish on /news until standard input ends. An argument is the number of bytes of each message."""

import sys
import threading

import coframe
from coframe.messages import find

STRING = find("std_msgs/msg/String")

ended = threading.Event()
threading.Thread(target=lambda: (sys.stdin.read(), ended.set()), daemon=True).start()
with coframe.connect("talker") as ros:
    publisher = ros.publisher("/news", STRING)
    print("ready", flush=True)
    while not ended.wait(0.02):
        publisher.publish(STRING(data="x" * int(sys.argv[1])))
