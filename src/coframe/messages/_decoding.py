# SPDX-License-Identifier: Apache-2.0
"""Compiler for functions that read messages from CDR or ROS 1, which check every length before they use it."""

from __future__ import annotations

import sys
from array import array
from typing import Any

import coframe.lazy_numpy as np
from coframe.messages._compiler import Compiler, Plan, RejectedValueError
from coframe.messages._fields import NumberFormat, number_of
from coframe.messages._layout import CODES, EMPTY_STRUCT_CODE, Offset, ros1_prefix, smallest_size
from coframe.messages.definition import (
    AbstractNestedType,
    AbstractType,
    AbstractWString,
    Array,
    BasicType,
    BoundedSequence,
    BoundedString,
    BoundedWString,
    NamespacedType,
)
from coframe.messages.encapsulation import HEADER_SIZE, Order
from coframe.messages.registry import class_of


def decoding(cls: Any, order: Order, *, is_ros1: bool = False) -> Plan:
    """Compile ``run(data)`` for messages of the class in one byte order. Its variable ``pos`` is the offset.

    It returns the message and its end.
    """
    return Plan(_Decoder(cls, order, is_ros1=is_ros1))


class _Decoder(Compiler):
    """Compiler for ``run(data)``, which returns the message in data and its end; CDR begins with a header."""

    def __init__(self, cls: Any, order: Order, *, is_ros1: bool) -> None:
        super().__init__(cls, order, "def run(data):", is_ros1=is_ros1)
        self.new = self.constant(object.__new__)
        self.emit(f"pos = {0 if is_ros1 else HEADER_SIZE}")
        self.emit("view = memoryview(data)")
        self._message(cls, "m")
        self.flush()
        self.emit("return m, pos")

    def flush(self) -> None:
        if (taken := self.take_run()) is None:
            return
        run, targets, subject = taken
        if len(run.layouts) == 1:
            layout = next(iter(run.layouts.values()))
            unpack, size = self.constant(layout.unpack_from), str(layout.size)
        else:
            unpack, size = self.variable(), self.variable()
            table = self.constant(run.by_offset(lambda layout: (layout.unpack_from, layout.size)))
            self.emit(f"{unpack}, {size} = {table}[pos & {run.alignment - 1}]")
        self.emit(f"{targets}, = {unpack}(data, pos)", subject)
        self.emit(f"pos += {size}")

    def member(self, type_: AbstractType, place: str) -> None:
        if isinstance(type_, BasicType):
            self.number(CODES[type_.typename], place)
        elif isinstance(type_, NamespacedType):
            self._message(class_of(type_), place)
        elif isinstance(type_, AbstractWString):
            self._wide_text(type_, place)
        elif isinstance(type_, AbstractNestedType):
            self._values(type_, place)
        else:
            self._text(type_, place)

    def _message(self, cls: Any, place: str) -> None:
        variable = self.variable()
        self.emit(f"{variable} = {place} = {self.new}({self.constant(cls)})")
        for code in ros1_prefix(cls) if self.is_ros1 else "":
            self.number(code, self.variable())
        if cls.SLOT_TYPES or self.is_ros1:
            self.members(cls, variable)
        else:
            self.number(EMPTY_STRUCT_CODE, self.variable())

    def _length(self) -> str:
        length = self.variable()
        self.number("I", length)
        self.flush()
        return length

    def _text(self, type_: AbstractType, place: str) -> None:
        length, end = self._length(), self.variable()
        self.emit(f"{end} = pos + {length}")
        if self.is_ros1:
            self._ros1_text(length, end, place)
            return
        # The only NUL must be the last byte. This also detects lengths beyond the data. Some writers use length 0
        # for an empty string.
        with self.block(f"if data.find(0, pos, {end}) != {end} - 1 and {length}:"):
            self.emit(f"raise {self.constant(_text_error)}(data, pos, {length})")
        self.emit(f"{place} = data[pos:{end} - 1].decode()")
        if isinstance(type_, BoundedString):
            self._check_bound(f"len({place})", type_.maximum_size, "characters")
        self.emit(f"pos = {end}")
        self.offset = Offset(1, 0)

    def _ros1_text(self, length: str, end: str, place: str) -> None:
        with self.block(f"if {end} > len(data):"):
            self.emit(f"raise {self.constant(_length_error)}(data, pos, {length}, 1)")
        self.emit(f"{place} = data[pos:{end}].decode()")
        self.emit(f"pos = {end}")

    def _wide_text(self, type_: AbstractWString, place: str) -> None:
        length = self._length()
        if isinstance(type_, BoundedWString):
            self._check_bound(length, type_.maximum_size, "characters")
        end = self._end(length, 4)
        self.emit(f"{place} = {self.constant(_from_utf16_units)}(data[pos:{end}], {self.needs_swap})")
        self.emit(f"pos = {end}")

    def _values(self, type_: AbstractNestedType, place: str) -> None:
        number = number_of(type_)
        if number and isinstance(type_, Array):
            self._number_array(type_, number, place)
            return
        if isinstance(type_, Array):
            self.flush()
            length = str(type_.size)
        else:
            length = self._length()
            if isinstance(type_, BoundedSequence):
                self._check_bound(length, type_.maximum_size, "values")
        if number:
            self._number_sequence(number, length, place)
        elif isinstance(type_.value_type, BasicType):
            self._bytes(type_.value_type, length, place)
        else:
            self._list(type_.value_type, length, place)

    def _number_array(self, type_: Array, number: NumberFormat, place: str) -> None:
        self.flush()
        self._align(number.itemsize)
        size = type_.size * number.itemsize
        end = self._end(str(type_.size), number.itemsize)
        stored = self.constant(number.dtype.newbyteorder(self.order))
        kept = self.constant(number.dtype)
        frombuffer = self.constant(np.frombuffer)
        self.emit(f"{place} = {frombuffer}(data, {stored}, {type_.size}, pos).astype({kept})")
        self.emit(f"pos = {end}")
        self.offset += size

    def _number_sequence(self, number: NumberFormat, length: str, place: str) -> None:
        values = self.variable()
        self.emit(f"{values} = {place} = array({number.code!r})")
        empty = self.offset
        with self.block(f"if {length}:"):
            self._align(number.itemsize)
            end = self._end(length, number.itemsize)
            self.emit(f"{values}.frombytes(view[pos:{end}])")
            if self.needs_swap:
                self.emit(f"{values}.byteswap()")
            self.emit(f"pos = {end}")
        self.offset = empty | Offset(number.itemsize, 0)

    def _bytes(self, value_type: BasicType, length: str, place: str) -> None:
        end = self._end(length, 1)
        if value_type.typename == "octet":
            self.emit(f"{place} = [data[i:i + 1] for i in range(pos, {end})]")
        else:
            self.emit(f"{place} = list(map({self.constant(bool)}, data[pos:{end}]))")
        self.emit(f"pos = {end}")
        self.offset = Offset(1, 0)

    def _list(self, value_type: AbstractType, length: str, place: str) -> None:
        smallest = smallest_size(value_type)
        with self.block(f"if {length} * {smallest} > len(data) - pos:"):
            self.emit(f"raise {self.constant(_length_error)}(data, pos, {length}, {smallest})")
        values, item = self.variable(), self.variable()
        self.emit(f"{values} = {place} = []")

        def body() -> None:
            self.member(value_type, item)
            self.emit(f"{values}.append({item})")

        self.loop(f"for _ in range({length}):", body)

    def _align(self, size: int) -> None:
        self.align(size, f"pos += {HEADER_SIZE} - pos & {size - 1}")

    def _end(self, length: str, size: int) -> str:
        """Return the variable with the offset after the values, after a check that they fit the data."""
        end = self.variable()
        self.emit(f"{end} = pos + {length} * {size}")
        with self.block(f"if {end} > len(data):"):
            self.emit(f"raise {self.constant(_length_error)}(data, pos, {length}, {size})")
        return end

    def _check_bound(self, length: str, bound: int, unit: str) -> None:
        with self.block(f"if {length} > {bound}:"):
            self.emit(f'raise RejectedValueError(f"at most {bound} {unit}, found {{{length}}}")')


def _text_error(data: bytes, pos: int, length: int) -> RejectedValueError:
    if pos + length > len(data):
        return _length_error(data, pos, length, 1)
    if data[pos + length - 1]:
        return RejectedValueError(
            f"a string of {length} bytes that ends with NUL, found {data[pos + length - 1]:#04x} at its end"
        )
    return RejectedValueError(f"a string of {length} bytes with a NUL only at its end, found one inside")


def _length_error(data: bytes, pos: int, length: int, size: int) -> RejectedValueError:
    each = "" if size == 1 else f" of at least {size} bytes each"
    unit = "bytes" if size == 1 else "values"
    return RejectedValueError(f"{length} {unit}{each}, found only {max(len(data) - pos, 0)} bytes")


def _from_utf16_units(data: bytes, swapped: bool) -> str:
    units = array("I", data)
    if swapped:
        units.byteswap()
    if units and max(units) > 0xFFFF:
        raise RejectedValueError(f"UTF-16 code units, found {max(units):#x}")
    return array("H", units).tobytes().decode("utf-16" + ("-le" if sys.byteorder == "little" else "-be"))
