# SPDX-License-Identifier: Apache-2.0
"""The nodes talker and listener of the ROS 2 tutorials."""
