# SPDX-License-Identifier: Apache-2.0
"""Names and texts that an attacker would choose, and what no output may contain of them."""

import re

ESCAPE = "esc\x1b[2J\x1b]0;hacked\x07"
NEWLINE = "two\nforged line"
NAMES = [
    ESCAPE,
    "rtl\u202egnp",
    "c1\x9b2Jend",
    "<img src=x onerror=alert(1)>",
    "[red]markup[/]",
    NEWLINE,
    "=cmd()",
    "'; rm -rf $(x) `y`",
    "m" * 1_000_000,
]
MAX_LINE_LENGTH = 4000  # characters

# What no command prints by itself; its own sequences for colors and the cursor are allowed in a terminal.
_FORBIDDEN = ("\x1b[2J", "\x1b]", "\x07", "\u202e", "\x9b")
_OWN_SEQUENCES = re.compile(r"\x1b\[[0-9;?]*[A-HJKhlm]|[\r\t]")


def problems(output, *, is_data=False, is_text=False):
    """Return what is wrong with the output of a command; lines of data may be long, and texts have several lines."""
    found = [f"{text!r} in {_around(output, text)}" for text in _FORBIDDEN if text in output]
    if "Traceback" in output:
        found.append(_around(output, "Traceback"))
    for line in _OWN_SEQUENCES.sub("", output).split("\n"):
        if control := [character for character in line if not character.isprintable()]:
            found.append(f"{control[:5]} in {line[:300]!r}")
        if "forged line" in line and "two" not in line and not is_text:
            found.append(f"a separate line: {line[:300]!r}")
        if len(line) > MAX_LINE_LENGTH and not is_data:
            found.append(f"a line of {len(line)} characters: {line[:300]!r}")
    return found


def _around(output, text):
    position = output.index(text)
    return repr(output[max(0, position - 200) : position + 600])
