# SPDX-License-Identifier: Apache-2.0
"""Find ROS packages and their executables: in a sourced workspace, in source folders without a build, and built-in."""
