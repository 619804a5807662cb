# SPDX-License-Identifier: Apache-2.0
"""tf2's buffer and exceptions with the API of the ROS 2 package `tf2_py`."""

from collections.abc import Iterator
from contextlib import contextmanager

from coframe.workspace import ros_side

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
    """Do nothing. Upstream exports this function, which it needs only on Windows.

    Args:
        env_name: Name of an environment variable that lists directories.
    """
    del env_name
    yield
