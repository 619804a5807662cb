# Written by scripts/generate_messages.py from interfaces/statistics_msgs/msg; do not edit.
import builtin_interfaces.msg
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["MetricsMessage", "StatisticDataPoint", "StatisticDataType"]

class MetricsMessage(Message):
    measurement_source_name: str
    metrics_source: str
    unit: str
    window_start: builtin_interfaces.msg.Time
    window_stop: builtin_interfaces.msg.Time
    statistics: list[StatisticDataPoint]
    def __init__(self, *, measurement_source_name: str = ..., metrics_source: str = ..., unit: str = ..., window_start: builtin_interfaces.msg.Time = ..., window_stop: builtin_interfaces.msg.Time = ..., statistics: list[StatisticDataPoint] = ...) -> None: ...

class StatisticDataPoint(Message):
    data_type: int
    data: float
    def __init__(self, *, data_type: int = ..., data: float = ...) -> None: ...

class StatisticDataType(Message):
    STATISTICS_DATA_TYPE_UNINITIALIZED: Final = 0
    STATISTICS_DATA_TYPE_AVERAGE: Final = 1
    STATISTICS_DATA_TYPE_MINIMUM: Final = 2
    STATISTICS_DATA_TYPE_MAXIMUM: Final = 3
    STATISTICS_DATA_TYPE_STDDEV: Final = 4
    STATISTICS_DATA_TYPE_SAMPLE_COUNT: Final = 5
    def __init__(self) -> None: ...

