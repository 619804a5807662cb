# SPDX-License-Identifier: Apache-2.0
"""Compiler for functions that write messages to CDR."""

from __future__ import annotations

import sys
from array import array
from typing import Any

import coframe.lazy_numpy as np
from coframe.messages._compiler import Compiler, Plan, RejectedValueError
from coframe.messages._fields import NumberFormat, number_of
from coframe.messages._layout import CODES, EMPTY_STRUCT_CODE, Offset
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
from coframe.messages.encapsulation import HEADER_SIZE
from coframe.messages.registry import class_of


def encoding(cls: Any) -> Plan:
    """Compile ``run(out, message)``, which appends a message of the class to a bytearray after the CDR header."""
    return Plan(_Encoder(cls))


class _Encoder(Compiler):
    """Compiler for ``run(out, m)``, which appends the message m to the bytearray out after its encapsulation header."""

    def __init__(self, cls: Any) -> None:
        super().__init__(cls, "<", "def run(out, m):")
        if cls.SLOT_TYPES:
            self.members(cls, "m")
        else:
            self.number(EMPTY_STRUCT_CODE, "0")
        self.flush()

    def flush(self) -> None:
        if (taken := self.take_run()) is None:
            return
        run, values, subject = taken
        if len(run.layouts) == 1:
            pack = self.constant(next(iter(run.layouts.values())).pack)
        else:
            packs = self.constant(run.by_offset(lambda layout: layout.pack))
            pack = f"{packs}[len(out) & {run.alignment - 1}]"
        self.emit(f"out += {pack}({values})", subject)

    def member(self, type_: AbstractType, place: str) -> None:
        if isinstance(type_, BasicType):
            self.number(CODES[type_.typename], place)
        elif isinstance(type_, NamespacedType):
            self._message(type_, place)
        elif isinstance(type_, AbstractWString):
            self._wide_text(type_, place)
        elif isinstance(type_, AbstractNestedType):
            self._values(type_, place)
        else:
            self._text(type_, place)

    def _message(self, type_: NamespacedType, place: str) -> None:
        cls = class_of(type_)
        if not cls.SLOT_TYPES:
            self.number(EMPTY_STRUCT_CODE, "0")
            return
        variable = self.variable()
        self.emit(f"{variable} = {place}")
        self.members(cls, variable)

    def _text(self, type_: AbstractType, place: str) -> None:
        text = self.variable()
        if isinstance(type_, BoundedString):
            self._reject_if(f"len({place}) > {type_.maximum_size}", f"more than {type_.maximum_size} characters")
        self.emit(f"{text} = {place}.encode()")
        self._reject_if(f"0 in {text}", "the string contains a NUL character, but ROS strings end at the first NUL")
        self.number("I", f"len({text}) + 1")
        self.flush()
        self.emit(f"out += {text}")
        self.after_text, self.offset = True, Offset(1, 0)

    def _wide_text(self, type_: AbstractWString, place: str) -> None:
        units = self.variable()
        if isinstance(type_, BoundedWString):
            self._reject_if(f"len({place}) > {type_.maximum_size}", f"more than {type_.maximum_size} characters")
        self.emit(f"{units} = {self.constant(_utf16_units)}({place})")
        self.number("I", f"len({units})")
        self.flush()
        self._swap(units)
        self.emit(f"out += {units}")

    def _values(self, type_: AbstractNestedType, place: str) -> None:
        number = number_of(type_)
        if number and isinstance(type_, Array):
            self._number_array(type_, number, place)
            return
        values = self.variable()
        self.emit(f"{values} = {place}")
        if isinstance(type_, Array):
            self._reject_if(f"len({values}) != {type_.size}", f"not {type_.size} values")
        else:
            if isinstance(type_, BoundedSequence):
                self._reject_if(f"len({values}) > {type_.maximum_size}", f"more than {type_.maximum_size} values")
            self.number("I", f"len({values})")
        self.flush()
        if number:
            self._number_sequence(number, values)
        elif isinstance(type_.value_type, BasicType):
            self._bytes(type_.value_type, values)
        else:
            item = self.variable()
            self.loop(f"for {item} in {values}:", lambda: self.member(type_.value_type, item))

    def _number_array(self, type_: Array, number: NumberFormat, place: str) -> None:
        self.flush()
        self._align(number.itemsize)
        dtype = self.constant(number.dtype.newbyteorder("<"))
        self.emit(f"out += {self.constant(_array_bytes)}({place}, {dtype}, {type_.size})")
        self.offset += type_.size * number.itemsize

    def _number_sequence(self, number: NumberFormat, values: str) -> None:
        with self.block(f"if {values}.typecode != {number.code!r}:"):
            self.emit(f"{values} = array({number.code!r}, {values})")
        self._swap(values)
        empty = self.offset
        with self.block(f"if {values}:"):  # An empty sequence has no padding.
            self._align(number.itemsize)
            self.emit(f"out += {values}")
        self.offset = empty | Offset(number.itemsize, 0)

    def _bytes(self, value_type: BasicType, values: str) -> None:
        if value_type.typename == "octet":
            self.emit(f'{values} = b"".join({values})')
        else:
            self.emit(f"{values} = bytes(map({self.constant(bool)}, {values}))")
        self.emit(f"out += {values}")
        self.offset = Offset(1, 0)

    def _align(self, size: int) -> None:
        padding = tuple(bytes((HEADER_SIZE - index) % size) for index in range(size))
        self.align(size, f"out += {self.constant(padding)}[len(out) & {size - 1}]")

    def _swap(self, values: str) -> None:
        if self.needs_swap:
            self.emit(f"{values} = {self.constant(_swap_bytes)}({values})")

    def _reject_if(self, condition: str, found: str) -> None:
        with self.block(f"if {condition}:"):
            self.emit(f"raise RejectedValueError({found!r})")


def _utf16_units(text: str) -> array[int]:
    return array("I", array("H", str(text).encode("utf-16" + ("-le" if sys.byteorder == "little" else "-be"))))


def _swap_bytes(values: array[Any]) -> array[Any]:
    copy = values[:]
    copy.byteswap()
    return copy


def _array_bytes(values: Any, dtype: np.dtype[Any], size: int) -> bytes:
    result = np.asarray(values, dtype)
    if result.size != size:
        raise RejectedValueError(f"not {size} numbers")
    return result.tobytes()
