# SPDX-License-Identifier: Apache-2.0
"""Test coframe beside ROS 2 from wheels: `python -m scripts.ros_wheels`."""
