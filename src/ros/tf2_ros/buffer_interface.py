# SPDX-License-Identifier: Apache-2.0
"""Interface of tf2 buffers, and the registries of the types that they can transform and convert."""

# The unused names are imported because programs import them from upstream's module.
from copy import deepcopy
from typing import Any, Callable, ClassVar, Dict, NoReturn, Optional, Tuple, Type, TypeVar, Union  # noqa: F401, UP035

import builtin_interfaces  # noqa: F401
import rclpy  # noqa: F401
import tf2_py as tf2  # noqa: F401
import tf2_ros  # noqa: F401
from builtin_interfaces.msg import Time as TimeMessage
from geometry_msgs.msg import (
    PointStamped,
    PoseStamped,
    PoseWithCovarianceStamped,
    TransformStamped,
    Vector3Stamped,
)
from rclpy.duration import Duration
from rclpy.time import Time
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import Header

MsgStamped = PointStamped | PoseStamped | PoseWithCovarianceStamped | Vector3Stamped | PointCloud2
TransformableObject = Any
TransformableObjectType = TypeVar("TransformableObjectType")
# The PyKDL types, for programs that register converters for them.
PyKDLType = TypeVar("PyKDLType")

_NO_WAIT = Duration()


class BufferInterface:
    """Base class of buffers that transforms stamped data with the `lookup_transform` of the subclass."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(
        self,
        object_stamped: Any,
        target_frame: str,
        timeout: Duration = _NO_WAIT,
        new_type: type | None = None,
    ) -> Any:
        """Transform stamped data into another frame at the time of the data.

        Args:
            object_stamped: Message with a header, of a registered type.
            target_frame: Frame to transform the message into.
            timeout: Maximum time to wait for the transform.
            new_type: Type to convert the result to.

        Raises:
            TypeException: The type of the data is not registered.
            TransformException: The transform is not available. The subclass and the message give the reason.
        """
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout)
        return _convert(do_transform(object_stamped, found), new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = _NO_WAIT,
        new_type: type | None = None,
    ) -> Any:
        """Transform stamped data into another frame at another time, fixed in `fixed_frame` between the two times.

        Raises:
            TypeException: The type of the data is not registered.
            TransformException: The transform is not available. The subclass and the message give the reason.
        """
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        return _convert(do_transform(object_stamped, found), new_type)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage, timeout: Duration = _NO_WAIT
    ) -> TransformStamped:
        """Return the transform from `source_frame` into `target_frame`. Subclasses implement this."""
        del target_frame, source_frame, time, timeout
        _not_implemented()

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = _NO_WAIT,
    ) -> TransformStamped:
        """Return the transform between two frames at two times. Subclasses implement this."""
        del target_frame, target_time, source_frame, source_time, fixed_frame, timeout
        _not_implemented()

    def can_transform(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage, timeout: Duration = _NO_WAIT
    ) -> Any:
        """Return whether `lookup_transform` would succeed. Subclasses implement this."""
        del target_frame, source_frame, time, timeout
        _not_implemented()

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = _NO_WAIT,
    ) -> Any:
        """Return whether `lookup_transform_full` would succeed. Subclasses implement this."""
        del target_frame, target_time, source_frame, source_time, fixed_frame, timeout
        _not_implemented()


def _not_implemented() -> NoReturn:
    raise NotImplementedException


def _convert(result: Any, new_type: type | None) -> Any:
    return result if new_type is None else convert(result, new_type)


def Stamped(obj: Any, stamp: TimeMessage, frame_id: str) -> Any:
    """Set the header of an object and return the object."""
    obj.header = Header(frame_id=frame_id, stamp=stamp)
    return obj


class TypeException(Exception):
    """A type is not registered."""

    def __init__(self, errstr: str) -> None:
        self.errstr = errstr
        super().__init__(errstr)


class NotImplementedException(Exception):
    """A buffer does not implement a method."""

    def __init__(self) -> None:
        self.errstr = "CanTransform or LookupTransform not implemented"
        super().__init__(self.errstr)


class TransformRegistration:
    """Registry of the functions `f(data, transform)` that transform stamped data, shared by all buffers."""

    __type_map: ClassVar[dict[type, Callable[[Any, TransformStamped], Any]]] = {}

    def print_me(self) -> None:
        """Print the registry."""
        print(self.__type_map)  # noqa: T201

    def add(self, key: type, callback: Callable[[Any, TransformStamped], Any]) -> None:
        """Register the function that transforms data of type `key`."""
        self.__type_map[key] = callback

    def get(self, key: type) -> Callable[[Any, TransformStamped], Any]:
        """Return the function for a type.

        Raises:
            TypeException: The type is not registered.
        """
        return _find_conversion(self.__type_map, key)


class ConvertRegistration:
    """Registry of converters between types and messages, and directly between types, shared by all buffers."""

    __to_msg_map: ClassVar[dict[type, Callable[[Any], Any]]] = {}
    __from_msg_map: ClassVar[dict[type, Callable[[Any], Any]]] = {}
    __convert_map: ClassVar[dict[tuple[type, type], Callable[[Any], Any]]] = {}

    def add_from_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Register the function that converts a message to the type `key`."""
        self.__from_msg_map[key] = callback

    def add_to_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Register the function that converts the type `key` to a message."""
        self.__to_msg_map[key] = callback

    def add_convert(self, key: tuple[type, type], callback: Callable[[Any], Any]) -> None:
        """Register the function that converts the first type of `key` directly to the second."""
        self.__convert_map[key] = callback

    def get_from_msg(self, key: type) -> Callable[[Any], Any]:
        """Return the function that converts a message to a type, or raise `TypeException`."""
        return _find_conversion(self.__from_msg_map, key)

    def get_to_msg(self, key: type) -> Callable[[Any], Any]:
        """Return the function that converts a type to a message, or raise `TypeException`."""
        return _find_conversion(self.__to_msg_map, key)

    def get_convert(self, key: tuple[type, type]) -> Callable[[Any], Any]:
        """Return the direct converter between two types, or raise `TypeException`."""
        return _find_conversion(self.__convert_map, key)


_Key = TypeVar("_Key")
_Value = TypeVar("_Value")


def _find_conversion(table: dict[_Key, _Value], key: _Key) -> _Value:
    try:
        return table[key]
    except KeyError:
        raise TypeException(f"Type {key} is not loaded or supported") from None


def convert(a: Any, b_type: type) -> Any:
    """Convert `a` to `b_type`, directly if a converter is registered, otherwise via a message.

    Raises:
        TypeException: No converter is registered.
    """
    registry = ConvertRegistration()
    try:
        direct = registry.get_convert((type(a), b_type))
    except TypeException:
        if type(a) is b_type:
            return deepcopy(a)
        to_msg = registry.get_to_msg(type(a))
        return registry.get_from_msg(b_type)(to_msg(a))
    return direct(a)
