# Written by scripts/generate_messages.py from interfaces/rosbag2_interfaces/msg; do not edit.
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ReadSplitEvent", "WriteSplitEvent"]

class ReadSplitEvent(Message):
    closed_file: str
    opened_file: str
    def __init__(self, *, closed_file: str = ..., opened_file: str = ...) -> None: ...

class WriteSplitEvent(Message):
    closed_file: str
    opened_file: str
    def __init__(self, *, closed_file: str = ..., opened_file: str = ...) -> None: ...

