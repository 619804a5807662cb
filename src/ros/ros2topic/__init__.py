# SPDX-License-Identifier: Apache-2.0
"""The part of ros2topic that scripts import."""
