# SPDX-License-Identifier: Apache-2.0
"""Compiler from a message type to a Python function that writes or reads messages of that type.

The compiler tracks what is known about the offset, joins adjacent numbers into one `struct` call, and prepares that
call once for each padding that can occur.
"""

from __future__ import annotations

import sys
from abc import ABC, abstractmethod
from array import array
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from coframe.errors import CoframeError
from coframe.messages._layout import Offset, Run, plan_run

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.messages.definition import AbstractType
    from coframe.messages.encapsulation import Order


class RejectedValueError(CoframeError, ValueError):
    """Bytes or values that the type does not allow. The message names the expected value."""


class Compiler(ABC):
    """Base class for compiling writers and readers: the source so far, and the numbers of the current run."""

    def __init__(self, cls: Any, order: Order, start: str, *, is_ros1: bool = False) -> None:
        self.cls = cls
        self.is_ros1 = is_ros1
        self.order = order
        self.needs_swap = (order == "<") != (sys.byteorder == "little")
        self.lines = [start]
        self.indent = 1
        self.names: dict[str, Any] = {"array": array, "RejectedValueError": RejectedValueError}
        self.offset = Offset(8, 0)
        self.codes = ""
        self.pending: list[str] = []
        self.pending_paths: list[str] = []
        self.after_text = False
        self.path: list[str] = []
        self.subjects: dict[int, str] = {}  # The fields that each line of the source handles.

    @abstractmethod
    def flush(self) -> None:
        """Emit the code that writes or reads the current run."""

    @abstractmethod
    def member(self, type_: AbstractType, place: str) -> None:
        """Compile one value, which the expression `place` refers to."""

    def emit(self, line: str, subject: str = "") -> None:
        """Add a line of source; `subject` names the fields that it handles, by default the current field."""
        self.lines.append("    " * self.indent + line)
        self.subjects[len(self.lines)] = subject or self.current_path()

    def current_path(self) -> str:
        """Return the path of the current field in the message."""
        return "".join(self.path).lstrip(".") or "the byte of an empty message"

    def constant(self, value: Any) -> str:
        """Return a name through which the compiled function can use the value."""
        name = f"c{len(self.names)}"
        self.names[name] = value
        return name

    def variable(self) -> str:
        """Return a new variable name."""
        name = f"v{len(self.names)}"
        self.names[name] = None
        return name

    @contextmanager
    def block(self, line: str) -> Iterator[None]:
        """Add a line that opens a block. Lines that are added inside the context are part of the block."""
        self.emit(line)
        self.indent += 1
        yield
        self.indent -= 1

    def number(self, code: str, expression: str) -> None:
        """Add a number to the current run, which is written from, or read into, the expression."""
        self.codes += code
        self.pending.append(expression)
        self.pending_paths.append(self.current_path())

    def take_run(self) -> tuple[Run, str, str] | None:
        """End the current run and return its layouts, its expressions and its fields, or None if the run is empty."""
        if not self.codes and not self.after_text:
            return None
        run = plan_run(self.codes, self.offset, self.order, after_text=self.after_text, is_ros1=self.is_ros1)
        expressions = ", ".join(self.pending)
        subject = " to ".join(dict.fromkeys([*self.pending_paths[:1], *self.pending_paths[-1:]]))
        self.codes, self.pending, self.pending_paths = "", [], []
        self.after_text, self.offset = False, run.end
        return run, expressions, subject

    def loop(self, line: str, body: Callable[[], None]) -> None:
        """Compile a loop. Its body must be valid for every offset that an iteration can start at."""
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
        """Compile all fields of the message in the variable."""
        for slot, type_ in zip(cls.__slots__, cls.SLOT_TYPES, strict=True):
            self.path.append(f".{slot[1:]}")
            self.member(type_, f"{variable}.{slot}")
            self.path.pop()

    def align(self, size: int, padding: str) -> None:
        """Add padding before numbers that are not part of a run."""
        if self.offset.starts(size) != [0] and not self.is_ros1:
            self.emit(padding)
            self.offset = Offset(size, 0)

    def function(self) -> Callable[..., Any]:
        """Return the function ``run`` that the source defines."""
        source = compile("\n".join(self.lines), f"<CDR of {self.cls.ROS_TYPE}>", "exec")
        exec(source, self.names)  # noqa: S102 - the source is generated above, from types of this package
        return self.names["run"]  # type: ignore[no-any-return]


class Plan:
    """A compiled function and the fields that its lines handle."""

    def __init__(self, compiler: Compiler) -> None:
        self.run = compiler.function()
        self._subjects = compiler.subjects

    def locate_error(self, error: BaseException) -> tuple[str, dict[str, Any]]:
        """Return the fields that `run` handled when it raised the error, and its local variables."""
        traceback = error.__traceback__
        while traceback is not None and traceback.tb_frame.f_code is not self.run.__code__:
            traceback = traceback.tb_next
        if traceback is None:
            raise error
        return self._subjects[traceback.tb_lineno], traceback.tb_frame.f_locals
