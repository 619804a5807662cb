# SPDX-License-Identifier: Apache-2.0
"""The error for a file on a server that cannot be read; it never contains passwords or signatures of URLs."""

from __future__ import annotations

import errno

from coframe._base_error import CoframeError

__all__ = ["RemoteFileError"]


class RemoteFileError(CoframeError, OSError):
    """A file on a server, or a file object, that cannot be read; ``strerror`` gives the reason."""

    @classmethod
    def because(cls, name: str, reason: str, hint: str = "", number: int = errno.EIO) -> RemoteFileError:
        """Return an error for a file.

        Args:
            name: The URL without credentials.
            reason: Why it cannot be read, as the end of a sentence.
            hint: What to do about it; may be empty.
            number: The number of a similar error of the operating system.
        """
        error = cls(number, reason, name)
        error._hint = hint
        return error

    def __str__(self) -> str:
        return f"{self.filename} cannot be read: {self.strerror}"

    def __reduce__(self) -> tuple[object, ...]:
        return type(self).because, (self.filename, self.strerror, self._hint, self.errno)
