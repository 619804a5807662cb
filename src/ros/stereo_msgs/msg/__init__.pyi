# Written by scripts/generate_messages.py from interfaces/stereo_msgs/msg; do not edit.
import numpy as np
import sensor_msgs.msg
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["DisparityImage"]

class DisparityImage(Message):
    header: std_msgs.msg.Header
    image: sensor_msgs.msg.Image
    f: float
    t: float
    valid_window: sensor_msgs.msg.RegionOfInterest
    min_disparity: float
    max_disparity: float
    delta_d: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., image: sensor_msgs.msg.Image = ..., f: float = ..., t: float = ..., valid_window: sensor_msgs.msg.RegionOfInterest = ..., min_disparity: float = ..., max_disparity: float = ..., delta_d: float = ...) -> None: ...

