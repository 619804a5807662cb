# SPDX-License-Identifier: Apache-2.0
"""A status message with methods that set its parts."""

from typing import Any

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

__all__ = ["DiagnosticStatusWrapper"]


class DiagnosticStatusWrapper(DiagnosticStatus):
    """A `diagnostic_msgs/DiagnosticStatus` with methods that set its summary and values."""

    def summary(self, *args: Any) -> None:
        """Set level and message: `summary(level, message)` or `summary(status)`."""
        self.level, self.message = _level_and_message(args)

    def clearSummary(self) -> None:
        """Set the level to OK and the message to an empty string."""
        self.summary(DiagnosticStatus.OK, "")

    def mergeSummary(self, *args: Any) -> None:
        """Add a level and message, as for `summary`.

        The higher level applies. Messages are joined if both are problems or both are not; otherwise, the message of
        the problem applies.
        """
        level, message = _level_and_message(args)
        if (level > DiagnosticStatus.OK) == (self.level > DiagnosticStatus.OK):
            self.message = f"{self.message}; {message}" if self.message else message
        elif level > self.level:
            self.message = message
        self.level = max(level, self.level)

    def add(self, key: str, val: Any) -> None:
        """Add a value."""
        self.values.append(KeyValue(key=key, value=str(val)))


def _level_and_message(args: tuple[Any, ...]) -> tuple[bytes, str]:
    if len(args) == 1:
        return args[0].level, args[0].message
    level, message = args
    return level, str(message)
