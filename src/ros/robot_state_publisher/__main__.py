# SPDX-License-Identifier: Apache-2.0
"""``python -m robot_state_publisher FILE --ros-args ...``."""

from robot_state_publisher import main

main()
