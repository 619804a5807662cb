"""ROS 2's transform system (tf2) for Python: any frame, any time, on any machine."""

import importlib
from typing import TYPE_CHECKING, Any

from coframe.buffer import Buffer, EdgeInfo, FrameInfo, Subscription
from coframe.errors import (
    ConnectivityException,
    DecodeError,
    ExtrapolationException,
    FrameMismatchException,
    InvalidArgumentException,
    LookupException,
    PackageError,
    RecordingError,
    RobotDescriptionError,
    TimeoutException,
    TransformException,
    WireError,
)
from coframe.transform import Transform
from coframe.wire.connection import Connection, connect

if TYPE_CHECKING:
    from coframe.bags import open_bag

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
    "PackageError",
    "RecordingError",
    "RobotDescriptionError",
    "Subscription",
    "TimeoutException",
    "Transform",
    "TransformException",
    "WireError",
    "__version__",
    "connect",
    "open_bag",
]


def __getattr__(name: str) -> Any:
    """What takes long to import, and few need, is imported when it is first used."""
    if name == "open_bag":
        return importlib.import_module("coframe.bags").open_bag
    if name in {"bags", "robots"}:
        return importlib.import_module(f"coframe.{name}")
    raise AttributeError(f"module 'coframe' has no attribute {name!r}")
