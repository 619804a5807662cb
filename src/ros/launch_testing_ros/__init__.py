# SPDX-License-Identifier: Apache-2.0
"""Tests of launched ROS systems: `launch_testing` with helpers for topics."""

from coframe.workspace import ros_side

ros_side.check(__name__)

from launch_testing_ros import actions, tools
from launch_testing_ros.data_republisher import DataRepublisher
from launch_testing_ros.message_pump import MessagePump
from launch_testing_ros.test_runner import LaunchTestRunner
from launch_testing_ros.wait_for_topics import WaitForTopics

__all__ = ["DataRepublisher", "LaunchTestRunner", "MessagePump", "WaitForTopics", "actions", "tools"]
