# SPDX-License-Identifier: Apache-2.0
"""The base classes of coframe's exceptions and warnings, for modules without the native core. See `coframe.errors`."""

from __future__ import annotations

import sys
import traceback

__all__ = ["CoframeError", "CoframeWarning"]

# The label of a hint in a traceback.
_HINT = "Hint: "


class CoframeError(Exception):
    """Base class of all exceptions that coframe raises by itself."""

    # There is no __init__ here: the native core raises transform exceptions often, and they have to stay cheap.
    _hint: str = ""

    @property
    def hint(self) -> str:
        """Advice on what to do next, in one or two sentences; may be empty."""
        return self._hint

    @property
    def doctor_code(self) -> str:
        """The code of the doctor's page about this problem, such as ``"TF013"``, or "" if there is none."""
        return ""

    # The interpreter reads the notes only when it prints a traceback, so other hints are never computed.
    @property
    def __notes__(self) -> list[str]:
        """The notes that a traceback shows below the message: the hint, and those added with ``add_note``."""
        notes: list[str] | None = self.__dict__.get("__notes__")
        if notes is None:
            notes = self.__dict__["__notes__"] = [f"{_HINT}{self.hint}"] if self.hint else []
        return notes

    @__notes__.setter
    def __notes__(self, notes: list[str]) -> None:
        self.__dict__["__notes__"] = notes

    def _render_traceback_(self) -> list[str]:
        """Return the traceback for IPython, which calls this method. Older versions do not show notes."""
        ipython = sys.modules.get("IPython")
        shell = ipython.get_ipython() if ipython else None
        if shell is None:
            lines = traceback.format_exception(type(self), self, self.__traceback__)
        else:
            lines = list(shell.InteractiveTB.structured_traceback(type(self), self, self.__traceback__))
        note = f"{_HINT}{self.hint}"
        return lines if not self.hint or note in "\n".join(lines) else [*lines, note]


class CoframeWarning(UserWarning):
    """A result is less accurate than it looks. Python's ``warnings`` module can show, suppress or raise it."""
