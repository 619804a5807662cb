# SPDX-License-Identifier: Apache-2.0
"""The error for launch files that no parser can read."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["InvalidLaunchFileError"]


class InvalidLaunchFileError(Exception):
    """A launch file that cannot be read.

    Args:
        extension: Extension of the file, without its dot.
        likely_errors: Exceptions of the parsers that have tried.
    """

    def __init__(self, extension: str = "", *, likely_errors: Sequence[BaseException] | None = None) -> None:
        self._extension = extension
        self._likely_errors = list(likely_errors or ())
        if self._extension == "":
            text = "The launch file may have a syntax error, or its format is unknown"
        else:
            text = f"Caught exception when trying to load file of format [{extension}]"
        if self._likely_errors:
            text += ": " + " --- ".join(str(error) for error in self._likely_errors)
            self.__cause__ = self._likely_errors[0]
        super().__init__(text)
