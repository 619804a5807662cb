# SPDX-License-Identifier: Apache-2.0
"""Names and texts that an attacker would choose."""

ESCAPE = "esc\x1b[2J\x1b]0;hacked\x07"
NAMES = [
    ESCAPE,
    "rtl\u202egnp",
    "c1\x9b2Jend",
    "<img src=x onerror=alert(1)>",
    "[red]markup[/]",
    "two\nlines",
    "=cmd()",
    "'; rm -rf $(x) `y`",
    "m" * 1_000_000,
]
