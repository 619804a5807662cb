# SPDX-License-Identifier: Apache-2.0
"""Communication with the ROS 2 graph over DDS, through the native classes of `coframe._core`."""
