# SPDX-License-Identifier: Apache-2.0
"""Receive on /news; the argument is the time in seconds. Print the length of the first message, or 0."""

import sys

import coframe
from coframe.errors import CoframeError
from coframe.messages import find

try:
    with coframe.connect("listener") as ros:
        message = ros.subscribe("/news", find("std_msgs/msg/String")).receive(f"{sys.argv[1]}s")
        print(0 if message is None else len(message.data))
except CoframeError as error:
    print(error, error.hint)
