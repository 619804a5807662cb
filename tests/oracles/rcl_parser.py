# SPDX-License-Identifier: Apache-2.0
"""rcl's parser of parameters, from the wheel ros-rcl-yaml-param-parser, by ctypes."""

from __future__ import annotations

import ctypes
import sysconfig
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["LIBRARY", "RclParser"]

LIBRARY = Path(sysconfig.get_path("data"), "lib", "librcl_yaml_param_parser.so")
_BUNDLED = Path(sysconfig.get_path("platlib"), "ros_rcl_yaml_param_parser.libs")


def _array(item: Any) -> Any:
    class Array(ctypes.Structure):
        _fields_ = [("values", ctypes.POINTER(item)), ("size", ctypes.c_size_t)]

    return ctypes.POINTER(Array)


class _Allocator(ctypes.Structure):
    _fields_ = [(name, ctypes.c_void_p) for name in ("allocate", "deallocate", "reallocate", "zero_allocate", "state")]


class _Strings(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("values", ctypes.POINTER(ctypes.c_char_p)), ("allocator", _Allocator)]


class _Variant(ctypes.Structure):
    _fields_ = [
        ("bool", ctypes.POINTER(ctypes.c_bool)),
        ("integer", ctypes.POINTER(ctypes.c_int64)),
        ("double", ctypes.POINTER(ctypes.c_double)),
        ("string", ctypes.c_char_p),
        ("bytes", _array(ctypes.c_uint8)),
        ("bools", _array(ctypes.c_bool)),
        ("integers", _array(ctypes.c_int64)),
        ("doubles", _array(ctypes.c_double)),
        ("strings", ctypes.POINTER(_Strings)),
    ]


class _Node(ctypes.Structure):
    _fields_ = [
        ("names", ctypes.POINTER(ctypes.c_char_p)),
        ("values", ctypes.POINTER(_Variant)),
        ("size", ctypes.c_size_t),
        ("capacity", ctypes.c_size_t),
    ]


class _Parameters(ctypes.Structure):
    _fields_ = [
        ("names", ctypes.POINTER(ctypes.c_char_p)),
        ("nodes", ctypes.POINTER(_Node)),
        ("size", ctypes.c_size_t),
        ("capacity", ctypes.c_size_t),
        ("allocator", _Allocator),
    ]


class RclParser:
    """rcl's parser. It has no values of their own for empty lists: these parameters are None."""

    def __init__(self) -> None:
        folder = LIBRARY.parent
        names = ["librcutils.so", "librosidl_runtime_c.so", "librosidl_dynamic_typesupport.so", "librmw.so"]
        for path in [*_BUNDLED.glob("*.so*"), *(folder / name for name in names)]:
            ctypes.CDLL(str(path), ctypes.RTLD_GLOBAL)
        self._utilities = ctypes.CDLL(str(folder / "librcutils.so"))
        self._utilities.rcutils_get_default_allocator.restype = _Allocator
        self._library = ctypes.CDLL(str(LIBRARY))
        self._library.rcl_yaml_node_struct_init.argtypes = [_Allocator]
        self._library.rcl_yaml_node_struct_init.restype = ctypes.POINTER(_Parameters)
        self._library.rcl_yaml_node_struct_fini.argtypes = [ctypes.POINTER(_Parameters)]
        for function in (self._library.rcl_parse_yaml_file, self._library.rcl_parse_yaml_value):
            function.restype = ctypes.c_bool

    def value(self, text: str) -> tuple[bool, Any]:
        """Return whether a text is accepted as the value of a parameter, and the value."""
        accepted, nodes = self._parse(
            lambda parameters: self._library.rcl_parse_yaml_value(b"node", b"name", text.encode(), parameters)
        )
        return accepted, nodes["node"]["name"] if accepted else None

    def file(self, path: Path) -> tuple[bool, dict[str, dict[str, Any]]]:
        """Return whether a file is accepted, and its values by node and name."""
        return self._parse(lambda parameters: self._library.rcl_parse_yaml_file(str(path).encode(), parameters))

    def _parse(self, parse: Callable[[Any], bool]) -> tuple[bool, dict[str, dict[str, Any]]]:
        self._utilities.rcutils_reset_error()
        parameters = self._library.rcl_yaml_node_struct_init(self._utilities.rcutils_get_default_allocator())
        try:
            accepted = parse(parameters)
            return accepted, _python_of(parameters.contents) if accepted else {}
        finally:
            self._library.rcl_yaml_node_struct_fini(parameters)


def _python_of(parameters: _Parameters) -> dict[str, dict[str, Any]]:
    return {
        parameters.names[i].decode(): {
            parameters.nodes[i].names[j].decode(): _value(parameters.nodes[i].values[j])
            for j in range(parameters.nodes[i].size)
        }
        for i in range(parameters.size)
    }


def _value(variant: _Variant) -> Any:
    """Return the value as rclpy reads it: the first field that is set."""
    for name in ("bool", "integer", "double"):
        if pointer := getattr(variant, name):
            return pointer[0]
    if variant.string is not None:
        return variant.string.decode()
    for name in ("bytes", "bools", "integers", "doubles"):
        if pointer := getattr(variant, name):
            return pointer.contents.values[: pointer.contents.size]
    if variant.strings:
        return [text.decode() for text in variant.strings.contents.values[: variant.strings.contents.size]]
    return None
