# SPDX-License-Identifier: Apache-2.0
"""ROS 2's transform system (tf2) for Python: any frame, any time, on any machine."""

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from coframe.bags import open_bag
    from coframe.buffer import Buffer, CallbackHandle, EdgeInfo, FrameInfo
    from coframe.buffer.frozen import load
    from coframe.connection.connection import Connection, connect
    from coframe.errors import (
        CoframeError,
        CoframeWarning,
        ConnectivityException,
        CourseError,
        DecodeError,
        EditError,
        ExtrapolationException,
        FrameMismatchException,
        FrozenFileError,
        InterfaceError,
        InvalidArgumentException,
        LookupException,
        PackageError,
        PlotError,
        PluginError,
        RecordingError,
        RobotDescriptionError,
        TimeoutException,
        TrajectoryError,
        TransformException,
        ViewerError,
        WireError,
    )
    from coframe.recorder import play, record
    from coframe.tf_relay import relay
    from coframe.transform.transform import Transform
    from coframe.viewer.show import show

    __version__: str

__all__ = [
    "Buffer",
    "CallbackHandle",
    "CoframeError",
    "CoframeWarning",
    "Connection",
    "ConnectivityException",
    "CourseError",
    "DecodeError",
    "EdgeInfo",
    "EditError",
    "ExtrapolationException",
    "FrameInfo",
    "FrameMismatchException",
    "FrozenFileError",
    "InterfaceError",
    "InvalidArgumentException",
    "LookupException",
    "PackageError",
    "PlotError",
    "PluginError",
    "RecordingError",
    "RobotDescriptionError",
    "TimeoutException",
    "TrajectoryError",
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

# Functions in modules that are slow to import are imported on first use.
_LAZY = {
    "load": "coframe.buffer.frozen",
    "open_bag": "coframe.bags",
    "play": "coframe.recorder",
    "record": "coframe.recorder",
    "relay": "coframe.tf_relay",
    "show": "coframe.viewer",
}
_PUBLIC_MODULES = {
    "bags",
    "calibration",
    "cameras",
    "doctor",
    "frame_names",
    "messages",
    "plotting",
    "quaternion",
    "recorder",
    "robots",
    "sensors",
    "time",
    "trajectories",
    "tree_drawing",
    "viewer",
}


# The other names are imported together on first use: the command line shows its help without NumPy.
_CORE = ("coframe.buffer", "coframe.connection", "coframe.errors", "coframe.transform")


def _publish(name: str, value: Any) -> Any:
    """Set `__module__` of a public class or function to `coframe`, from which users import it.

    The drop-in package tf2_py has already given tf2's exceptions the name of upstream's module; they keep it.
    """
    if value.__module__ != "tf2":
        value.__module__ = __name__
    globals()[name] = value
    return value


def _import_core() -> None:
    modules = [importlib.import_module(name) for name in _CORE]
    for name in __all__:
        if name not in _LAZY and name != "__version__":
            _publish(name, next(getattr(module, name) for module in modules if hasattr(module, name)))


def __getattr__(name: str) -> Any:
    """Import a function or module of the public interface on first use."""
    if name == "__version__":
        return importlib.import_module("importlib.metadata").version("coframe")
    if name in __all__:
        _import_core()
    if name in _LAZY:
        return _publish(name, getattr(importlib.import_module(_LAZY[name]), name))
    if name in globals():
        return globals()[name]
    if name in _PUBLIC_MODULES or f"coframe.{name}" in _CORE:
        return importlib.import_module(f"coframe.{name}")
    raise AttributeError(f"module 'coframe' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*__all__, *_PUBLIC_MODULES})
