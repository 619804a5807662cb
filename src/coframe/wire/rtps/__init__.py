# SPDX-License-Identifier: Apache-2.0
"""What the middlewares of the DDS standard share: the ROS graph over DDS discovery, whatever library implements it."""
