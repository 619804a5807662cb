# Written by scripts/generate_messages.py from interfaces/rosbag2_interfaces/srv; do not edit.
import builtin_interfaces.msg
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["Burst", "GetRate", "IsPaused", "Pause", "Play", "PlayNext", "Resume", "Seek", "SetRate", "Snapshot", "SplitBagfile", "Stop", "TogglePaused"]

class Burst_Request(Message):
    num_messages: int
    def __init__(self, *, num_messages: int = ...) -> None: ...

class Burst_Response(Message):
    actually_burst: int
    def __init__(self, *, actually_burst: int = ...) -> None: ...

class Burst(Service):
    Request: TypeAlias = Burst_Request
    Response: TypeAlias = Burst_Response

class GetRate_Request(Message):
    def __init__(self) -> None: ...

class GetRate_Response(Message):
    rate: float
    def __init__(self, *, rate: float = ...) -> None: ...

class GetRate(Service):
    Request: TypeAlias = GetRate_Request
    Response: TypeAlias = GetRate_Response

class IsPaused_Request(Message):
    def __init__(self) -> None: ...

class IsPaused_Response(Message):
    paused: bool
    def __init__(self, *, paused: bool = ...) -> None: ...

class IsPaused(Service):
    Request: TypeAlias = IsPaused_Request
    Response: TypeAlias = IsPaused_Response

class Pause_Request(Message):
    def __init__(self) -> None: ...

class Pause_Response(Message):
    def __init__(self) -> None: ...

class Pause(Service):
    Request: TypeAlias = Pause_Request
    Response: TypeAlias = Pause_Response

class Play_Request(Message):
    start_offset: builtin_interfaces.msg.Time
    playback_duration: builtin_interfaces.msg.Duration
    playback_until_timestamp: builtin_interfaces.msg.Time
    def __init__(self, *, start_offset: builtin_interfaces.msg.Time = ..., playback_duration: builtin_interfaces.msg.Duration = ..., playback_until_timestamp: builtin_interfaces.msg.Time = ...) -> None: ...

class Play_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class Play(Service):
    Request: TypeAlias = Play_Request
    Response: TypeAlias = Play_Response

class PlayNext_Request(Message):
    def __init__(self) -> None: ...

class PlayNext_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class PlayNext(Service):
    Request: TypeAlias = PlayNext_Request
    Response: TypeAlias = PlayNext_Response

class Resume_Request(Message):
    def __init__(self) -> None: ...

class Resume_Response(Message):
    def __init__(self) -> None: ...

class Resume(Service):
    Request: TypeAlias = Resume_Request
    Response: TypeAlias = Resume_Response

class Seek_Request(Message):
    time: builtin_interfaces.msg.Time
    def __init__(self, *, time: builtin_interfaces.msg.Time = ...) -> None: ...

class Seek_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class Seek(Service):
    Request: TypeAlias = Seek_Request
    Response: TypeAlias = Seek_Response

class SetRate_Request(Message):
    rate: float
    def __init__(self, *, rate: float = ...) -> None: ...

class SetRate_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class SetRate(Service):
    Request: TypeAlias = SetRate_Request
    Response: TypeAlias = SetRate_Response

class Snapshot_Request(Message):
    def __init__(self) -> None: ...

class Snapshot_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class Snapshot(Service):
    Request: TypeAlias = Snapshot_Request
    Response: TypeAlias = Snapshot_Response

class SplitBagfile_Request(Message):
    def __init__(self) -> None: ...

class SplitBagfile_Response(Message):
    def __init__(self) -> None: ...

class SplitBagfile(Service):
    Request: TypeAlias = SplitBagfile_Request
    Response: TypeAlias = SplitBagfile_Response

class Stop_Request(Message):
    def __init__(self) -> None: ...

class Stop_Response(Message):
    def __init__(self) -> None: ...

class Stop(Service):
    Request: TypeAlias = Stop_Request
    Response: TypeAlias = Stop_Response

class TogglePaused_Request(Message):
    def __init__(self) -> None: ...

class TogglePaused_Response(Message):
    def __init__(self) -> None: ...

class TogglePaused(Service):
    Request: TypeAlias = TogglePaused_Request
    Response: TypeAlias = TogglePaused_Response

