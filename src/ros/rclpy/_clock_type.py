# SPDX-License-Identifier: Apache-2.0
"""Clock types. They are separate from clock.py, because `Time` needs them and the clocks need `Time`."""

from enum import IntEnum


class ClockType(IntEnum):
    """Type of a clock.

    - ROS_TIME: simulated time if `use_sim_time` is set, otherwise system time.
    - SYSTEM_TIME: time since the Unix epoch. It jumps when the system clock is set.
    - STEADY_TIME: time since an arbitrary start. It never jumps.
    """

    UNINITIALIZED = 0
    ROS_TIME = 1
    SYSTEM_TIME = 2
    STEADY_TIME = 3
