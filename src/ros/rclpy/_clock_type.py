"""The kinds of clocks (apart from clock.py, which needs Time, which needs this)."""

from enum import IntEnum


class ClockType(IntEnum):
    """What a clock counts.

    - ROS_TIME: the simulator's time where `use_sim_time` is set, else the system's time.
    - SYSTEM_TIME: time since 1970; may jump when somebody sets the clock.
    - STEADY_TIME: time since some start; never jumps.
    """

    UNINITIALIZED = 0
    ROS_TIME = 1
    SYSTEM_TIME = 2
    STEADY_TIME = 3
