"""What every tf2 buffer can do with stamped data, and the two registries of types it can do it with."""

# What is not used here is here because upstream leaks it.
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
# PyKDL's types, for those who registered converters for them.
PyKDLType = TypeVar("PyKDLType")

_NO_WAIT = Duration()


class BufferInterface:
    """Transforming stamped data, on top of whatever answers `lookup_transform`."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(
        self,
        object_stamped: Any,
        target_frame: str,
        timeout: Duration = _NO_WAIT,
        new_type: type | None = None,
    ) -> Any:
        """Express stamped data in another frame, at the data's own time.

        Args:
            object_stamped: A message with a header, of a type that was registered.
            target_frame: Name of the frame to express it in.
            timeout: How long to wait for the transform.
            new_type: A type to convert the result to.

        Raises:
            TypeException: The type of the data was not registered.
            TransformException: The transform is not known; one of its children says why.
        """
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout)
        return _converted(do_transform(object_stamped, found), new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = _NO_WAIT,
        new_type: type | None = None,
    ) -> Any:
        """Express stamped data in another frame at another time; the data stand still in `fixed_frame`.

        Raises:
            TypeException: The type of the data was not registered.
            TransformException: The transform is not known; one of its children says why.
        """
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        return _converted(do_transform(object_stamped, found), new_type)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage, timeout: Duration = _NO_WAIT
    ) -> TransformStamped:
        """The transform from `source_frame` to `target_frame`; for a child class to answer."""
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
        """The transform between two frames at two times; for a child class to answer."""
        del target_frame, target_time, source_frame, source_time, fixed_frame, timeout
        _not_implemented()

    def can_transform(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage, timeout: Duration = _NO_WAIT
    ) -> Any:
        """Return whether `lookup_transform` would answer; for a child class to answer."""
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
        """Return whether `lookup_transform_full` would answer; for a child class to answer."""
        del target_frame, target_time, source_frame, source_time, fixed_frame, timeout
        _not_implemented()


def _not_implemented() -> NoReturn:
    raise NotImplementedException


def _converted(result: Any, new_type: type | None) -> Any:
    return result if new_type is None else convert(result, new_type)


def Stamped(obj: Any, stamp: TimeMessage, frame_id: str) -> Any:
    """Give an object a header and return it."""
    obj.header = Header(frame_id=frame_id, stamp=stamp)
    return obj


class TypeException(Exception):
    """A type nobody registered."""

    def __init__(self, errstr: str) -> None:
        self.errstr = errstr
        super().__init__(errstr)


class NotImplementedException(Exception):
    """A buffer that does not offer this question."""

    def __init__(self) -> None:
        self.errstr = "CanTransform or LookupTransform not implemented"
        super().__init__(self.errstr)


class TransformRegistration:
    """Type of stamped data -> function(data, transform) -> data in the other frame; one table for everyone."""

    __type_map: ClassVar[dict[type, Callable[[Any, TransformStamped], Any]]] = {}

    def print_me(self) -> None:
        """Print the table."""
        print(self.__type_map)  # noqa: T201 - printing is what it is for

    def add(self, key: type, callback: Callable[[Any, TransformStamped], Any]) -> None:
        """Register how data of type `key` are transformed."""
        self.__type_map[key] = callback

    def get(self, key: type) -> Callable[[Any, TransformStamped], Any]:
        """The function for a type.

        Raises:
            TypeException: The type was not registered.
        """
        return _registered(self.__type_map, key)


class ConvertRegistration:
    """Type -> functions to and from messages, and direct converters between two types; one table for everyone."""

    __to_msg_map: ClassVar[dict[type, Callable[[Any], Any]]] = {}
    __from_msg_map: ClassVar[dict[type, Callable[[Any], Any]]] = {}
    __convert_map: ClassVar[dict[tuple[type, type], Callable[[Any], Any]]] = {}

    def add_from_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Register how a message becomes a `key`."""
        self.__from_msg_map[key] = callback

    def add_to_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Register how a `key` becomes a message."""
        self.__to_msg_map[key] = callback

    def add_convert(self, key: tuple[type, type], callback: Callable[[Any], Any]) -> None:
        """Register how the first type of `key` becomes the second, without a message between."""
        self.__convert_map[key] = callback

    def get_from_msg(self, key: type) -> Callable[[Any], Any]:
        """The function from a message; raises `TypeException` if there is none."""
        return _registered(self.__from_msg_map, key)

    def get_to_msg(self, key: type) -> Callable[[Any], Any]:
        """The function to a message; raises `TypeException` if there is none."""
        return _registered(self.__to_msg_map, key)

    def get_convert(self, key: tuple[type, type]) -> Callable[[Any], Any]:
        """The direct converter; raises `TypeException` if there is none."""
        return _registered(self.__convert_map, key)


_Key = TypeVar("_Key")
_Value = TypeVar("_Value")


def _registered(table: dict[_Key, _Value], key: _Key) -> _Value:
    try:
        return table[key]
    except KeyError:
        raise TypeException(f"Type {key} is not loaded or supported") from None


def convert(a: Any, b_type: type) -> Any:
    """Turn `a` into a `b_type`: directly if a converter is registered, else by way of a message.

    Raises:
        TypeException: No way is registered.
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
