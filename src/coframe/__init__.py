"""ROS 2's transform system (tf2) for Python: any frame, any time, on any machine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

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
    ViewerError,
    WireError,
)
from coframe.transform import Transform
from coframe.wire.connection import Connection, connect

if TYPE_CHECKING:
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
    "InvalidArgumentException",
    "LookupException",
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
    "show",
]


def __getattr__(name: str) -> Any:
    """The viewer, when somebody wants it: `import coframe` stays cheap."""
    if name == "show":
        from coframe.viewer.show import show  # noqa: PLC0415 - see above

        return show
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
