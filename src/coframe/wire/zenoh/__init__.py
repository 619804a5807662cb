# SPDX-License-Identifier: Apache-2.0
"""Communication with the ROS 2 graph over Zenoh, in the conventions of rmw_zenoh_cpp."""
