# SPDX-License-Identifier: Apache-2.0
"""``--install-completion``: scripts for TAB completion of commands, options, recordings and frames.

click generates the scripts; this module detects the shell and installs them.
"""

from __future__ import annotations

import os
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING, Final

from click.shell_completion import get_completion_class

from coframe._files.os_errors import explain
from coframe._files.regular_files import read_regular_text
from coframe.cli.output import fail

if TYPE_CHECKING:
    from collections.abc import Iterator

    import click

__all__ = ["install", "script"]

MAX_BYTES: Final = 1 << 20  # of a configuration file
MAX_ANCESTORS: Final = 10  # processes between the shell and this one
_ZSH_LINES: Final = ("fpath+=~/.zfunc; autoload -Uz compinit; compinit", "zstyle ':completion:*' menu select")
# zsh runs a file of ~/.zfunc at each TAB. The script of click completes at the first one; at the second it only
# registers its function, so that nothing would be completed before the third.
_ZSH_FIRST_CALL: Final = '\n[[ $zsh_eval_context[-1] == shfunc ]] && {function} "$@"\n'
_SHELLS: Final = ("bash", "zsh", "fish")


def script(ctx: click.Context) -> str:
    """Return the script for the shell that started this process."""
    return _script(_shell(), ctx)


def install(ctx: click.Context) -> None:
    """Install the script for the shell that started this process."""
    shell, program = _shell(), str(ctx.info_name)
    text = _script(shell, ctx)
    home = Path.home()
    try:
        if shell == "fish":
            path = home / ".config" / "fish" / "completions" / f"{program}.fish"
        elif shell == "zsh":
            path = home / ".zfunc" / f"_{program}"
            _add_lines(home / ".zshrc", _ZSH_LINES)
        else:
            path = home / ".bash_completions" / f"{program}.sh"
            _add_lines(home / ".bashrc", (f"source '{path}'",))
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        fail(f"the completion for {shell} cannot be installed: {explain(error)}")
    print(f"{shell} completion installed in {path}\nOpen a new terminal to use it.")


def _script(shell: str, ctx: click.Context) -> str:
    program = str(ctx.info_name)
    completion = get_completion_class(shell)
    if completion is None:
        raise LookupError(shell)
    source = completion(ctx.command, {}, program, f"_{program.upper()}_COMPLETE")
    return source.source() + (_ZSH_FIRST_CALL.format(function=source.func_name) if shell == "zsh" else "")


def _add_lines(file: Path, lines: tuple[str, ...]) -> None:
    """Append the lines that a configuration file does not contain."""
    text = read_regular_text(file, MAX_BYTES) if file.exists() else ""
    missing = [line for line in lines if line not in text]
    if missing:
        start = text if not text or text.endswith("\n") else f"{text}\n"
        file.write_text(start + "".join(f"{line}\n" for line in missing), encoding="utf-8")


def _shell() -> str:
    """Return the name of the shell that started this process, or the user's default shell."""
    names = [*_ancestors(), Path(os.environ.get("SHELL", "")).name]
    shell = next((name for name in names if name in _SHELLS), None)
    if shell is None:
        fail(
            f"no completion is available for the shell {names[-1] or 'of this system'}",
            f"Shells: {', '.join(_SHELLS)}.",
        )
    return shell


def _ancestors() -> Iterator[str]:
    """Yield the names of the ancestors of this process, parent first."""
    process = os.getppid()
    for _ in range(MAX_ANCESTORS):
        name, process = _name_and_parent(process)
        if not name:
            return
        yield name.lstrip("-")  # login shells begin with a dash


def _name_and_parent(process: int) -> tuple[str, int]:
    """Return the name of a process and its parent's ID, or nothing if unknown."""
    try:
        start, _, rest = Path(f"/proc/{process}/stat").read_text(encoding="utf-8", errors="replace").rpartition(")")
        return start.partition("(")[2], int(rest.split()[1])
    except (OSError, ValueError, IndexError):
        pass  # Only Linux has /proc.
    try:
        command = ["ps", "-o", "ppid=,comm=", "-p", str(process)]
        parent, name = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split(maxsplit=1)  # noqa: S603
        return Path(name.strip()).name, int(parent)
    except (OSError, ValueError, subprocess.CalledProcessError):
        return "", 0
