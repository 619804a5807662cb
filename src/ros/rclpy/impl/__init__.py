# SPDX-License-Identifier: Apache-2.0
"""Implementation modules of rclpy. Users import them only for type annotations."""
