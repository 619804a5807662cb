# SPDX-License-Identifier: Apache-2.0
"""coframe's tf2 inside a sourced ROS 2: tf2_ros's classes for the rclpy nodes and messages of the sourced ROS.

Importing this module replaces the packages tf2_py and tf2_ros of the process with coframe's, so that all packages that
use them, such as tf2_geometry_msgs, work with the same classes. All other packages remain those of the ROS
installation. Without a sourced ROS, these are the classes of coframe's tf2_ros.

A listener receives transforms in native code, without the interpreter lock and without an executor, through a hidden
node of coframe in the domain and namespace of the ROS node. This works with every middleware that is based on DDS, and
with rmw_zenoh if coframe[zenoh] is installed. With ``TransformListener(..., wire="rclpy")`` or
``COFRAME_ROS2_WIRE=rclpy``, it subscribes through the ROS node instead, which works with every middleware.

``python -m coframe.ros2 node.py`` runs an unchanged program in the same way.

Example:
    >>> from coframe.ros2 import Buffer, TransformListener                   # doctest: +SKIP
    >>> buffer = Buffer()                                                    # doctest: +SKIP
    >>> listener = TransformListener(buffer, node)                           # doctest: +SKIP
"""

from coframe.ros2 import _replacement

_replacement.install()

from tf2_ros import (  # noqa: E402 - this must import coframe's tf2_ros
    Buffer,
    BufferClient,
    BufferInterface,
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    StaticTransformBroadcaster,
    TimeoutException,
    TransformBroadcaster,
    TransformException,
    TransformListener,
)

__all__ = [
    "Buffer",
    "BufferClient",
    "BufferInterface",
    "ConnectivityException",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "StaticTransformBroadcaster",
    "TimeoutException",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
]
