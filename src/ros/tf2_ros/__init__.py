# SPDX-License-Identifier: Apache-2.0
"""tf2 for nodes: buffers, listeners and broadcasters.

The upstream package has no `__all__`, and programs rely on names that its modules import. These names are exported
here as well.
"""

from coframe.workspace import ros_side

ros_side.check(__name__)


import threading
import warnings
from collections.abc import Callable
from copy import deepcopy
from threading import Thread
from time import sleep
from typing import Any, Dict, List, NoReturn, Optional, Tuple, Type, TypeVar, Union  # noqa: UP035 - leaked upstream

import builtin_interfaces
import rclpy
import tf2_py as tf2
import tf2_ros
from geometry_msgs.msg import (
    PointStamped,
    PoseStamped,
    PoseWithCovarianceStamped,
    TransformStamped,
    Vector3Stamped,
)
from rclpy.action import ActionClient
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock, JumpThreshold, TimeJump
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
from rclpy.task import Future
from rclpy.time import Time
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import Header
from tf2_msgs.action import LookupTransform
from tf2_msgs.msg import TFMessage
from tf2_msgs.srv import FrameGraph
from tf2_py import (
    BufferCore,
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
    add_dll_directories_from_env,
)
from tf2_ros.buffer import Buffer, FrameGraphSrvRequest, FrameGraphSrvResponse
from tf2_ros.buffer_client import BufferClient, LookupTransformGoal, LookupTransformResult
from tf2_ros.buffer_interface import (
    BufferInterface,
    ConvertRegistration,
    MsgStamped,
    NotImplementedException,
    PyKDLType,
    Stamped,
    TransformableObject,
    TransformableObjectType,
    TransformRegistration,
    TypeException,
    convert,
)
from tf2_ros.buffer_server import BufferServer
from tf2_ros.message_filter import FilterFailureReason, FilterStatistics, MessageFilter
from tf2_ros.static_transform_broadcaster import DEFAULT_STATIC_TF_TOPIC, StaticTransformBroadcaster
from tf2_ros.static_transform_listener import StaticTransformListener
from tf2_ros.transform_broadcaster import DEFAULT_TF_TOPIC, TransformBroadcaster
from tf2_ros.transform_listener import TransformListener

__all__ = [
    "DEFAULT_STATIC_TF_TOPIC",
    "DEFAULT_TF_TOPIC",
    "ActionClient",
    "Any",
    "Buffer",
    "BufferClient",
    "BufferCore",
    "BufferInterface",
    "BufferServer",
    "Callable",
    "Clock",
    "ConnectivityException",
    "ConvertRegistration",
    "Dict",
    "DurabilityPolicy",
    "Duration",
    "ExtrapolationException",
    "FilterFailureReason",
    "FilterStatistics",
    "FrameGraph",
    "FrameGraphSrvRequest",
    "FrameGraphSrvResponse",
    "Future",
    "Header",
    "HistoryPolicy",
    "InvalidArgumentException",
    "JumpThreshold",
    "List",
    "LookupException",
    "LookupTransform",
    "LookupTransformGoal",
    "LookupTransformResult",
    "MessageFilter",
    "MsgStamped",
    "NoReturn",
    "Node",
    "NotImplementedException",
    "Optional",
    "PointCloud2",
    "PointStamped",
    "PoseStamped",
    "PoseWithCovarianceStamped",
    "PyKDLType",
    "QoSProfile",
    "ReentrantCallbackGroup",
    "SingleThreadedExecutor",
    "Stamped",
    "StaticTransformBroadcaster",
    "StaticTransformListener",
    "TFMessage",
    "Thread",
    "Time",
    "TimeJump",
    "TimeoutException",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
    "TransformRegistration",
    "TransformStamped",
    "TransformableObject",
    "TransformableObjectType",
    "Tuple",
    "Type",
    "TypeException",
    "TypeVar",
    "Union",
    "Vector3Stamped",
    "add_dll_directories_from_env",
    "builtin_interfaces",
    "convert",
    "deepcopy",
    "rclpy",
    "sleep",
    "tf2",
    "tf2_ros",
    "threading",
    "warnings",
]
