# Written by scripts/generate_messages.py from interfaces/rosbag2_interfaces/msg; do not edit.
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["MessagesLostEvent", "MessagesLostEventTopicStat", "ReadSplitEvent", "WriteSplitEvent"]

class MessagesLostEvent(Message):
    node_name: str
    messages_lost_statistics: list[MessagesLostEventTopicStat]
    def __init__(self, *, node_name: str = ..., messages_lost_statistics: list[MessagesLostEventTopicStat] = ...) -> None: ...

class MessagesLostEventTopicStat(Message):
    topic_name: str
    messages_lost_in_transport: int
    messages_lost_in_recorder: int
    def __init__(self, *, topic_name: str = ..., messages_lost_in_transport: int = ..., messages_lost_in_recorder: int = ...) -> None: ...

class ReadSplitEvent(Message):
    closed_file: str
    opened_file: str
    node_name: str
    def __init__(self, *, closed_file: str = ..., opened_file: str = ..., node_name: str = ...) -> None: ...

class WriteSplitEvent(Message):
    closed_file: str
    opened_file: str
    node_name: str
    def __init__(self, *, closed_file: str = ..., opened_file: str = ..., node_name: str = ...) -> None: ...

