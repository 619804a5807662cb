# SPDX-License-Identifier: Apache-2.0
"""Limits on message definitions. A definition of a few bytes could otherwise take any amount of time and memory.

They apply to the files of users and to the definitions in recordings, unless a comment says otherwise.
"""

from __future__ import annotations

__all__ = [
    "MAX_BYTES",
    "MAX_CONSTANTS",
    "MAX_DEFINITION",
    "MAX_DEPTH",
    "MAX_DIGITS",
    "MAX_FIELDS",
    "MAX_LINE",
    "MAX_LOOPS",
    "MAX_NESTING",
    "MAX_RECORDED_FIELDS",
    "MAX_RECORDED_TEXT",
    "MAX_TYPES",
    "MAX_VALUES",
    "check_digits",
]

# The text.
MAX_DEFINITION = 1 << 20  # bytes of a definition in a recording, with those of the types inside the message
MAX_RECORDED_TEXT = 8 << 20  # bytes of all different definitions of a recording
MAX_LINE = 20_000  # characters of a line without its comment, and of a string in IDL
MAX_DIGITS = 400  # characters of a number: the largest double has 309 digits before its point
MAX_NESTING = 20  # nested modules and parentheses of IDL; rosidl needs three modules

# The messages.
MAX_TYPES = 1_000  # of a definition in a recording
MAX_CONSTANTS = 2_000  # of a definition
MAX_FIELDS = 20_000  # of a message and all messages inside it; public messages have fewer than 2 000
MAX_DEPTH = 64  # nested messages
MAX_LOOPS = 16  # sequences inside the messages of a sequence; Python allows 20 nested loops
MAX_BYTES = 64 << 20  # of a message with default values
MAX_VALUES = 2**32 - 1  # of an array, sequence or string: CDR counts them with 32 bits
MAX_RECORDED_FIELDS = 100_000  # of all classes that are made from the definitions in a recording


def check_digits(text: str) -> None:
    """Raise ValueError if a number has too many digits to be read."""
    if len(text) > MAX_DIGITS:
        raise ValueError(f"a number has {len(text)} characters; the maximum is {MAX_DIGITS}")
