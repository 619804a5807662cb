# SPDX-License-Identifier: Apache-2.0
"""ROS workspaces and ROS installations on the disk: their packages, executables and interfaces."""
