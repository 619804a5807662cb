"""ROS 2's transform system (tf2) for Python: any frame, any time, on any machine."""

import importlib
from typing import TYPE_CHECKING, Any

from coframe.buffer import Buffer, EdgeInfo, FrameInfo, Subscription
from coframe.connection import Connection, connect
from coframe.errors import (
    ConnectivityException,
    DecodeError,
    ExtrapolationException,
    FrameMismatchException,
    FrozenFileError,
    InvalidArgumentException,
    LookupException,
    PackageError,
    RecordingError,
    RobotDescriptionError,
    TimeoutException,
    TransformException,
    ViewerError,
    WireError,
)
from coframe.transform import Transform

if TYPE_CHECKING:
    from coframe.bags import open_bag
    from coframe.frozen import load
    from coframe.recorder import play, record
    from coframe.tf_relay import relay
    from coframe.viewer.show import show

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
    "FrozenFileError",
    "InvalidArgumentException",
    "LookupException",
    "PackageError",
    "RecordingError",
    "RobotDescriptionError",
    "Subscription",
    "TimeoutException",
    "Transform",
    "TransformException",
    "ViewerError",
    "WireError",
    "__version__",
    "connect",
    "load",
    "open_bag",
    "play",
    "record",
    "relay",
    "show",
]

_LATE = {
    "load": "coframe.frozen",
    "open_bag": "coframe.bags",
    "play": "coframe.recorder",
    "record": "coframe.recorder",
    "relay": "coframe.tf_relay",
    "show": "coframe.viewer",
}


def __getattr__(name: str) -> Any:
    """What takes long to import, and few need, is imported when it is first used."""
    if name in _LATE:
        return getattr(importlib.import_module(_LATE[name]), name)
    if name in {"bags", "recorder", "robots", "viewer"}:
        return importlib.import_module(f"coframe.{name}")
    raise AttributeError(f"module 'coframe' has no attribute {name!r}")
