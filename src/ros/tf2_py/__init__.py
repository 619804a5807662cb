"""tf2's buffer and exceptions, as the ROS 2 package `tf2_py` has them."""

from collections.abc import Iterator
from contextlib import contextmanager

from coframe import ros_side

ros_side.check(__name__)


from tf2_py._tf2_py import (
    BufferCore,
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)

__all__ = [
    "BufferCore",
    "ConnectivityException",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "TimeoutException",
    "TransformException",
    "add_dll_directories_from_env",
]


@contextmanager
def add_dll_directories_from_env(env_name: str) -> Iterator[None]:
    """Here because upstream leaks it; what it does on Windows, nothing of ours needs.

    Args:
        env_name: Name of an environment variable with a list of folders.
    """
    del env_name
    yield
