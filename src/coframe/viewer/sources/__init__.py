# SPDX-License-Identifier: Apache-2.0
"""Sources that the viewer can show: the ROS graph, a recording or a buffer."""
