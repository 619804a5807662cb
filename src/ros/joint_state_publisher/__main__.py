# SPDX-License-Identifier: Apache-2.0
"""``python -m joint_state_publisher [FILE] --ros-args ...``."""

from joint_state_publisher import main

main()
