# Written by scripts/generate_messages.py from interfaces/pendulum_msgs/msg; do not edit.
import builtin_interfaces.msg
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["JointCommand", "JointState", "RttestResults"]

class JointCommand(Message):
    position: float
    def __init__(self, *, position: float = ...) -> None: ...

class JointState(Message):
    position: float
    velocity: float
    effort: float
    def __init__(self, *, position: float = ..., velocity: float = ..., effort: float = ...) -> None: ...

class RttestResults(Message):
    stamp: builtin_interfaces.msg.Time
    command: JointCommand
    state: JointState
    cur_latency: int
    mean_latency: float
    min_latency: int
    max_latency: int
    minor_pagefaults: int
    major_pagefaults: int
    def __init__(self, *, stamp: builtin_interfaces.msg.Time = ..., command: JointCommand = ..., state: JointState = ..., cur_latency: int = ..., mean_latency: float = ..., min_latency: int = ..., max_latency: int = ..., minor_pagefaults: int = ..., major_pagefaults: int = ...) -> None: ...

