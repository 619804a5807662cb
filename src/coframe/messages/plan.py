"""Compiles how a message type is written to and read from CDR: one Python function a type.

CDR (XCDR1) aligns every number to its own size, counted from the end of the 4-byte encapsulation header. Texts make
the offsets after them unknown, but never wholly: after a 4-byte length, an offset is a multiple of four again. The
compiler follows what is known about the offset (`Offset`), joins neighbouring numbers to one `struct` call, and
prepares that call once for each padding that can occur.
"""

from __future__ import annotations

import struct
import sys
from abc import ABC, abstractmethod
from array import array
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

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
from coframe.messages.fields import NUMBERS, Number, number_of
from coframe.messages.registry import find

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

Order = Literal["<", ">"]  # little or big endian, as struct and numpy write it

HEADER_SIZE = 4
_CODES = {"boolean": "?", "octet": "c", **{name: number.code for name, number in NUMBERS.items()}}
_SIZES = {code: struct.calcsize(f"<{code}") for code in "?cbBhHiIqQfd"}
_STRUCTURE_WITHOUT_MEMBERS = "B"  # C has no empty structures: rosidl puts one byte into them


class RefusedError(ValueError):
    """The bytes or values are not what the type allows; says what was expected."""


class Offset(NamedTuple):
    """What is known about an offset: its remainder when divided by modulus (1, 2, 4 or 8)."""

    modulus: int
    remainder: int

    def __add__(self, size: int) -> Offset:  # type: ignore[override]
        return Offset(self.modulus, (self.remainder + size) % self.modulus)

    def __or__(self, other: Offset) -> Offset:
        modulus = min(self.modulus, other.modulus)
        while self.remainder % modulus != other.remainder % modulus:
            modulus //= 2
        return Offset(modulus, self.remainder % modulus)

    def starts(self, alignment: int) -> list[int]:
        """The remainders modulo `alignment` that the offset can have."""
        step = min(self.modulus, alignment)
        return list(range(self.remainder % step, alignment, step))


class Run(NamedTuple):
    """Neighbouring numbers, after the NUL of a text where there is one: their layout for each possible start."""

    layouts: dict[int, struct.Struct]
    alignment: int
    end: Offset


def plan_run(codes: str, start: Offset, order: str, *, after_text: bool) -> Run:
    """Lays neighbouring numbers out for every offset they can start at."""
    alignment = max((_SIZES[code] for code in codes), default=1)
    layouts: dict[int, struct.Struct] = {}
    end: Offset | None = None
    for first in start.starts(alignment):
        position, text = first, order
        if after_text:
            position, text = position + 1, text + "x"
        for code in codes:
            padding = -position % _SIZES[code]
            position += padding + _SIZES[code]
            text += "x" * padding + code
        layouts[first] = struct.Struct(text)
        reached = Offset(max(start.modulus, alignment), 0) + position
        if start.modulus > alignment:
            reached = start + (position - first)
        end = reached if end is None else end | reached
    assert end is not None
    return Run(layouts, alignment, end)


def smallest_size(type_: AbstractType) -> int:
    """The least number of bytes a value can take; never 0, so that a length can be held against what is there."""
    if isinstance(type_, NamespacedType):
        cls = find("/".join(type_.namespaced_name()))
        return max(1, sum(map(smallest_size, cls.SLOT_TYPES)))
    if isinstance(type_, Array):
        return type_.size * smallest_size(type_.value_type)
    return _SIZES[_CODES[type_.typename]] if isinstance(type_, BasicType) else 4


class _Compiler(ABC):
    """What writing and reading have in common: the source so far and the numbers waiting to join a run."""

    def __init__(self, cls: Any, order: Order, start: str) -> None:
        self.cls = cls
        self.order = order
        self.swapped = (order == "<") != (sys.byteorder == "little")
        self.lines = [start]
        self.indent = 1
        self.names: dict[str, Any] = {"array": array, "RefusedError": RefusedError}
        self.offset = Offset(8, 0)
        self.codes = ""
        self.waiting: list[str] = []
        self.waiting_paths: list[str] = []
        self.after_text = False
        self.path: list[str] = []
        self.subjects: dict[int, str] = {}  # by line of the source: the fields it deals with

    @abstractmethod
    def flush(self) -> None:
        """Writes or reads the run that waits."""

    @abstractmethod
    def member(self, type_: AbstractType, place: str) -> None:
        """One value, at the place that the expression names."""

    def emit(self, line: str, subject: str = "") -> None:
        self.lines.append("    " * self.indent + line)
        self.subjects[len(self.lines)] = subject or self.here()

    def here(self) -> str:
        return "".join(self.path).lstrip(".") or "its one byte"

    def constant(self, value: Any) -> str:
        name = f"c{len(self.names)}"
        self.names[name] = value
        return name

    def variable(self) -> str:
        name = f"v{len(self.names)}"
        self.names[name] = None
        return name

    @contextmanager
    def block(self, line: str) -> Iterator[None]:
        self.emit(line)
        self.indent += 1
        yield
        self.indent -= 1

    def number(self, code: str, expression: str) -> None:
        """One number to write from, or to read into, the expression."""
        self.codes += code
        self.waiting.append(expression)
        self.waiting_paths.append(self.here())

    def take_run(self) -> tuple[Run, str, str] | None:
        """Ends the run: its layouts, its expressions and its fields' names; None if nothing waits."""
        if not self.codes and not self.after_text:
            return None
        run = plan_run(self.codes, self.offset, self.order, after_text=self.after_text)
        expressions = ", ".join(self.waiting)
        subject = " to ".join(dict.fromkeys([*self.waiting_paths[:1], *self.waiting_paths[-1:]]))
        self.codes, self.waiting, self.waiting_paths = "", [], []
        self.after_text, self.offset = False, run.end
        return run, expressions, subject

    def loop(self, line: str, body: Callable[[], None]) -> None:
        """A loop; its body is compiled for what is known about the offset at the start of every round."""
        self.flush()
        while True:
            mark, start = len(self.lines), self.offset
            self.path.append("[]")
            with self.block(line):
                body()
                self.flush()
            self.path.pop()
            self.offset = start | self.offset
            if self.offset == start:
                return
            del self.lines[mark:]

    def members(self, cls: Any, variable: str) -> None:
        """All fields of the message that the variable holds."""
        for slot, type_ in zip(cls.__slots__, cls.SLOT_TYPES, strict=True):
            self.path.append(f".{slot[1:]}")
            self.member(type_, f"{variable}.{slot}")
            self.path.pop()

    def align(self, size: int, padding: str) -> None:
        """Padding before numbers that are not part of a run."""
        if self.offset.starts(size) != [0]:
            self.emit(padding)
            self.offset = Offset(size, 0)

    def function(self) -> Callable[..., Any]:
        source = compile("\n".join(self.lines), f"<CDR of {self.cls.ROS_TYPE}>", "exec")
        exec(source, self.names)  # noqa: S102 - written above, from our own types
        return self.names["run"]  # type: ignore[no-any-return]


def _indexed(run: Run, entry: Callable[[struct.Struct], Any]) -> tuple[Any, ...]:
    """The entries of a run by the offset from the first byte of the message, modulo the run's alignment."""
    starts = ((index - HEADER_SIZE) % run.alignment for index in range(run.alignment))
    return tuple(entry(run.layouts[start]) if start in run.layouts else None for start in starts)


class _Encoder(_Compiler):
    """Compiles ``run(out, m)``: appends message m to the bytearray out, which begins with the header."""

    def __init__(self, cls: Any) -> None:
        super().__init__(cls, "<", "def run(out, m):")
        if cls.SLOT_TYPES:
            self.members(cls, "m")
        else:
            self.number(_STRUCTURE_WITHOUT_MEMBERS, "0")
        self.flush()

    def flush(self) -> None:
        if (taken := self.take_run()) is None:
            return
        run, values, subject = taken
        if len(run.layouts) == 1:
            pack = self.constant(next(iter(run.layouts.values())).pack)
        else:
            packs = self.constant(_indexed(run, lambda layout: layout.pack))
            pack = f"{packs}[len(out) & {run.alignment - 1}]"
        self.emit(f"out += {pack}({values})", subject)

    def member(self, type_: AbstractType, place: str) -> None:
        if isinstance(type_, BasicType):
            self.number(_CODES[type_.typename], place)
        elif isinstance(type_, NamespacedType):
            self._message(type_, place)
        elif isinstance(type_, AbstractWString):
            self._wide_text(type_, place)
        elif isinstance(type_, AbstractNestedType):
            self._values(type_, place)
        else:
            self._text(type_, place)

    def _message(self, type_: NamespacedType, place: str) -> None:
        cls = find("/".join(type_.namespaced_name()))
        if not cls.SLOT_TYPES:
            self.number(_STRUCTURE_WITHOUT_MEMBERS, "0")
            return
        variable = self.variable()
        self.emit(f"{variable} = {place}")
        self.members(cls, variable)

    def _text(self, type_: AbstractType, place: str) -> None:
        text = self.variable()
        if isinstance(type_, BoundedString):
            self._refuse_if(f"len({place}) > {type_.maximum_size}", f"more than {type_.maximum_size} characters")
        self.emit(f"{text} = {place}.encode()")
        self._refuse_if(f"0 in {text}", "a NUL inside the text; ROS ends texts with NUL")
        self.number("I", f"len({text}) + 1")
        self.flush()
        self.emit(f"out += {text}")
        self.after_text, self.offset = True, Offset(1, 0)

    def _wide_text(self, type_: AbstractWString, place: str) -> None:
        units = self.variable()
        if isinstance(type_, BoundedWString):
            self._refuse_if(f"len({place}) > {type_.maximum_size}", f"more than {type_.maximum_size} characters")
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
            self._refuse_if(f"len({values}) != {type_.size}", f"not {type_.size} values")
        else:
            if isinstance(type_, BoundedSequence):
                self._refuse_if(f"len({values}) > {type_.maximum_size}", f"more than {type_.maximum_size} values")
            self.number("I", f"len({values})")
        self.flush()
        if number:
            self._number_sequence(number, values)
        elif isinstance(type_.value_type, BasicType):
            self._bytes(type_.value_type, values)
        else:
            item = self.variable()
            self.loop(f"for {item} in {values}:", lambda: self.member(type_.value_type, item))

    def _number_array(self, type_: Array, number: Number, place: str) -> None:
        self.flush()
        self._align(number.dtype.itemsize)
        dtype = self.constant(number.dtype.newbyteorder("<"))
        self.emit(f"out += {self.constant(_array_bytes)}({place}, {dtype}, {type_.size})")
        self.offset += type_.size * number.dtype.itemsize

    def _number_sequence(self, number: Number, values: str) -> None:
        with self.block(f"if {values}.typecode != {number.code!r}:"):
            self.emit(f"{values} = array({number.code!r}, {values})")
        self._swap(values)
        empty = self.offset
        with self.block(f"if {values}:"):  # what is not there needs no padding
            self._align(number.dtype.itemsize)
            self.emit(f"out += {values}")
        self.offset = empty | Offset(number.dtype.itemsize, 0)

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
        if self.swapped:
            self.emit(f"{values} = {self.constant(_swapped)}({values})")

    def _refuse_if(self, condition: str, found: str) -> None:
        with self.block(f"if {condition}:"):
            self.emit(f"raise RefusedError({f'{self.here()}: {found}'!r})")


class _Decoder(_Compiler):
    """Compiles ``run(data)``: the message in data, which begins with the header."""

    def __init__(self, cls: Any, order: Order) -> None:
        super().__init__(cls, order, "def run(data):")
        self.new = self.constant(object.__new__)
        self.emit(f"pos = {HEADER_SIZE}")
        self.emit("view = memoryview(data)")
        self._message(cls, "m")
        self.flush()
        self.emit("return m")

    def flush(self) -> None:
        if (taken := self.take_run()) is None:
            return
        run, targets, subject = taken
        if len(run.layouts) == 1:
            layout = next(iter(run.layouts.values()))
            unpack, size = self.constant(layout.unpack_from), str(layout.size)
        else:
            unpack, size = self.variable(), self.variable()
            table = self.constant(_indexed(run, lambda layout: (layout.unpack_from, layout.size)))
            self.emit(f"{unpack}, {size} = {table}[pos & {run.alignment - 1}]")
        self.emit(f"{targets}, = {unpack}(data, pos)", subject)
        self.emit(f"pos += {size}")

    def member(self, type_: AbstractType, place: str) -> None:
        if isinstance(type_, BasicType):
            self.number(_CODES[type_.typename], place)
        elif isinstance(type_, NamespacedType):
            self._message(find("/".join(type_.namespaced_name())), place)
        elif isinstance(type_, AbstractWString):
            self._wide_text(type_, place)
        elif isinstance(type_, AbstractNestedType):
            self._values(type_, place)
        else:
            self._text(type_, place)

    def _message(self, cls: Any, place: str) -> None:
        variable = self.variable()
        self.emit(f"{variable} = {place} = {self.new}({self.constant(cls)})")
        if cls.SLOT_TYPES:
            self.members(cls, variable)
        else:
            self.number(_STRUCTURE_WITHOUT_MEMBERS, self.variable())

    def _length(self) -> str:
        length = self.variable()
        self.number("I", length)
        self.flush()
        return length

    def _text(self, type_: AbstractType, place: str) -> None:
        length, end = self._length(), self.variable()
        self.emit(f"{end} = pos + {length}")
        # Exactly one NUL, at the end, also finds ends beyond the data. Some writers give an empty text length 0.
        with self.block(f"if data.find(0, pos, {end}) != {end} - 1 and {length}:"):
            self.emit(f"raise {self.constant(_text_refusal)}(data, pos, {length})")
        self.emit(f"{place} = data[pos:{end} - 1].decode()")
        if isinstance(type_, BoundedString):
            self._check_bound(f"len({place})", type_.maximum_size, "characters")
        self.emit(f"pos = {end}")
        self.offset = Offset(1, 0)

    def _wide_text(self, type_: AbstractWString, place: str) -> None:
        length = self._length()
        if isinstance(type_, BoundedWString):
            self._check_bound(length, type_.maximum_size, "characters")
        end = self._end(length, 4)
        self.emit(f"{place} = {self.constant(_from_utf16_units)}(data[pos:{end}], {self.swapped})")
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

    def _number_array(self, type_: Array, number: Number, place: str) -> None:
        self.flush()
        self._align(number.dtype.itemsize)
        size = type_.size * number.dtype.itemsize
        end = self._end(str(type_.size), number.dtype.itemsize)
        stored = self.constant(number.dtype.newbyteorder(self.order))
        kept = self.constant(number.dtype)
        frombuffer = self.constant(np.frombuffer)
        self.emit(f"{place} = {frombuffer}(data, {stored}, {type_.size}, pos).astype({kept})")
        self.emit(f"pos = {end}")
        self.offset += size

    def _number_sequence(self, number: Number, length: str, place: str) -> None:
        values = self.variable()
        self.emit(f"{values} = {place} = array({number.code!r})")
        empty = self.offset
        with self.block(f"if {length}:"):
            self._align(number.dtype.itemsize)
            end = self._end(length, number.dtype.itemsize)
            self.emit(f"{values}.frombytes(view[pos:{end}])")
            if self.swapped:
                self.emit(f"{values}.byteswap()")
            self.emit(f"pos = {end}")
        self.offset = empty | Offset(number.dtype.itemsize, 0)

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
            self.emit(f"raise {self.constant(_length_refusal)}(data, pos, {length}, {smallest})")
        values, item = self.variable(), self.variable()
        self.emit(f"{values} = {place} = []")

        def body() -> None:
            self.member(value_type, item)
            self.emit(f"{values}.append({item})")

        self.loop(f"for _ in range({length}):", body)

    def _align(self, size: int) -> None:
        self.align(size, f"pos += {HEADER_SIZE} - pos & {size - 1}")

    def _end(self, length: str, size: int) -> str:
        """The offset after so many values of that size, held against the data."""
        end = self.variable()
        self.emit(f"{end} = pos + {length} * {size}")
        with self.block(f"if {end} > len(data):"):
            self.emit(f"raise {self.constant(_length_refusal)}(data, pos, {length}, {size})")
        return end

    def _check_bound(self, length: str, bound: int, what: str) -> None:
        with self.block(f"if {length} > {bound}:"):
            self.emit(f'raise RefusedError(f"at most {bound} {what}, but there are {{{length}}}")')


def encoder(cls: Any) -> Callable[[bytearray, Any], None]:
    """The function that appends a message of the class to a bytearray that begins with the header."""
    return _Encoder(cls).function()


class Decoder:
    """Reads messages of one class in one byte order, ``<`` or ``>``."""

    def __init__(self, cls: Any, order: Order) -> None:
        compiler = _Decoder(cls, order)
        self.run: Callable[[bytes], Any] = compiler.function()
        self._subjects = compiler.subjects

    def where(self, error: BaseException) -> tuple[int, str]:
        """The offset at which `run` failed, and the fields it was reading."""
        traceback = error.__traceback__
        while traceback is not None and traceback.tb_frame.f_code is not self.run.__code__:
            traceback = traceback.tb_next
        assert traceback is not None
        return traceback.tb_frame.f_locals["pos"], self._subjects[traceback.tb_lineno]


def _text_refusal(data: bytes, pos: int, length: int) -> RefusedError:
    if pos + length > len(data):
        return _length_refusal(data, pos, length, 1)
    if data[pos + length - 1]:
        return RefusedError(
            f"a text of {length} bytes that ends with NUL, but it ends with {data[pos + length - 1]:#04x}"
        )
    return RefusedError(f"a text of {length} bytes whose only NUL is at its end, but there is one inside")


def _length_refusal(data: bytes, pos: int, length: int, size: int) -> RefusedError:
    each = "" if size == 1 else f" of at least {size} bytes each"
    what = "bytes" if size == 1 else "values"
    return RefusedError(f"{length} {what}{each}, but {max(len(data) - pos, 0)} bytes are left")


def _utf16_units(text: str) -> array[int]:
    return array("I", array("H", str(text).encode("utf-16" + ("-le" if sys.byteorder == "little" else "-be"))))


def _from_utf16_units(data: bytes, swapped: bool) -> str:
    units = array("I", data)
    if swapped:
        units.byteswap()
    if units and max(units) > 0xFFFF:
        raise RefusedError(f"UTF-16 code units, but there is {max(units):#x}")
    return array("H", units).tobytes().decode("utf-16" + ("-le" if sys.byteorder == "little" else "-be"))


def _swapped(values: array[Any]) -> array[Any]:
    copy = values[:]
    copy.byteswap()
    return copy


def _array_bytes(values: Any, dtype: np.dtype[Any], size: int) -> bytes:
    result = np.asarray(values, dtype)
    if result.size != size:
        raise RefusedError(f"not {size} numbers")
    return result.tobytes()
