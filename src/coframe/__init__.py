"""ROS 2's transform system (tf2) for Python: any frame, any time, on any machine."""

from coframe.buffer import Buffer, EdgeInfo, FrameInfo, Subscription
from coframe.errors import (
    ConnectivityException,
    DecodeError,
    ExtrapolationException,
    FrameMismatchException,
    InvalidArgumentException,
    LookupException,
    RecordingError,
    RobotDescriptionError,
    TimeoutException,
    TransformException,
    WireError,
)
from coframe.transform import Transform
from coframe.wire.connection import Connection, connect

__version__ = "0.1.0"

__all__ = [
    "Buffer",
    "Connection",
    "ConnectivityException",
    "DecodeError",
    "EdgeInfo",
    "ExtrapolationException",
    "FrameInfo",
    "FrameMismatchException",
    "InvalidArgumentException",
    "LookupException",
    "RecordingError",
    "RobotDescriptionError",
    "Subscription",
    "TimeoutException",
    "Transform",
    "TransformException",
    "WireError",
    "__version__",
    "connect",
]
