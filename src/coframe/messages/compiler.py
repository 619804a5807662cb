"""Compiles a message type to one Python function that writes or reads it.

The compiler follows what is known about the offset, joins neighbouring numbers to one `struct` call, and prepares
that call once for each padding that can occur.
"""

from __future__ import annotations

import sys
from abc import ABC, abstractmethod
from array import array
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from coframe.errors import CoframeError
from coframe.messages.layout import Offset, Run, plan_run

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.messages.definition import AbstractType
    from coframe.messages.encapsulation import Order


class RefusedError(CoframeError, ValueError):
    """Bytes or values that the type does not allow; the text says what was expected."""


class Compiler(ABC):
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
        """Adds a line of source; subject names the fields it deals with, by default the current one."""
        self.lines.append("    " * self.indent + line)
        self.subjects[len(self.lines)] = subject or self.here()

    def here(self) -> str:
        """The name of the current field, from the message on."""
        return "".join(self.path).lstrip(".") or "its one byte"

    def constant(self, value: Any) -> str:
        """A name by which the function can use the value."""
        name = f"c{len(self.names)}"
        self.names[name] = value
        return name

    def variable(self) -> str:
        """A name for a variable that no other line uses."""
        name = f"v{len(self.names)}"
        self.names[name] = None
        return name

    @contextmanager
    def block(self, line: str) -> Iterator[None]:
        """Adds a line that opens a block; what follows belongs to it."""
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
        """The function ``run`` that the source defines."""
        source = compile("\n".join(self.lines), f"<CDR of {self.cls.ROS_TYPE}>", "exec")
        exec(source, self.names)  # noqa: S102 - written above, from our own types
        return self.names["run"]  # type: ignore[no-any-return]


class Plan:
    """A compiled function and what its lines deal with."""

    def __init__(self, compiler: Compiler) -> None:
        self.run = compiler.function()
        self._subjects = compiler.subjects

    def where(self, error: BaseException) -> tuple[str, dict[str, Any]]:
        """The fields that `run` dealt with when it failed, and its variables."""
        traceback = error.__traceback__
        while traceback is not None and traceback.tb_frame.f_code is not self.run.__code__:
            traceback = traceback.tb_next
        if traceback is None:
            raise error
        return self._subjects[traceback.tb_lineno], traceback.tb_frame.f_locals
