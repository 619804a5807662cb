# SPDX-License-Identifier: Apache-2.0
"""Completion at the first TAB of a new zsh.

zsh runs the file that typer installs when TAB is pressed for the first time. The file only defines the function that
completes, so nothing was completed before the second TAB.
"""

from __future__ import annotations

import contextlib
from pathlib import Path

from coframe.regular_files import read_regular_text

__all__ = ["complete_at_first_tab"]

_MAX_BYTES = 1 << 20  # of a script; that of typer has 500


def complete_at_first_tab(program: str) -> None:
    """Let the installed completion of a program, if there is one for zsh, complete when zsh loads it."""
    file = Path.home() / ".zfunc" / f"_{program}"
    function = f"_{program}_completion"
    call = f'[[ $funcstack[1] == _{program} ]] && {function} "$@"'
    with contextlib.suppress(OSError, UnicodeDecodeError):
        script = read_regular_text(file, _MAX_BYTES)
        if f"{function}()" in script and call not in script:
            file.write_text(f"{script.rstrip()}\n\n{call}\n", encoding="utf-8")
