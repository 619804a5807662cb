# SPDX-License-Identifier: Apache-2.0
"""The command line ``coframe``: one module for each command."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

from coframe.cli.streams import (
    accept_any_encoding,
    discard_output,
    flush_output,
    replace_closed_streams,
    undecodable,
)
from coframe.cli.system_errors import description
from coframe.signal_handlers import clear_handled_interrupt

if TYPE_CHECKING:
    from collections.abc import Collection

    import typer

__all__ = ["main", "run"]

# The shell sets one of these variables when it asks a program for completions.
_COMPLETING = {"_COFRAME_COMPLETE", "_ROS2_COMPLETE"}
_INTERRUPTED = 130  # exit code: 128 + SIGINT, as shells have it
# The extra that installs each package which a command may need.
_EXTRAS = {
    "lz4": "bags",
    "matplotlib": "plot",
    "pyarrow": "parquet",
    "pydyf": "pdf",
    "websockets": "viewer",
    "xacro": "robots",
    "yaml": "bags",
    "zstandard": "bags",
}


def main() -> None:
    """Run the console script ``coframe``."""
    run(sys.argv[1:])


def run(words: list[str], *, program: str = "coframe", shown: Collection[str] | None = None) -> None:
    """Run a command line and end the process.

    Args:
        words: The arguments.
        program: The name of the program in its help.
        shown: The commands that exist. None: all.
    """
    replace_closed_streams()
    accept_any_encoding()
    if bad := next(filter(undecodable, words), None):
        print(f"coframe: the argument {bad[:60]!r} is not valid UTF-8.", file=sys.stderr)
        sys.exit(2)
    try:
        try:
            _app(_command_name(words), program, shown)(words, prog_name=program)
        finally:
            flush_output()
    except ModuleNotFoundError as error:
        sys.exit(_what_to_install(error))
    except KeyboardInterrupt:  # Ctrl-C during the imports.
        sys.exit(_INTERRUPTED)
    except BrokenPipeError:  # The reader of a pipe, such as `head`, has closed it.
        discard_output()
        sys.exit(1)
    except OSError as error:
        discard_output()
        sys.exit(description(error))
    finally:
        clear_handled_interrupt()
        if "--install-completion" in words:
            from coframe.cli.zsh_completion import complete_at_first_tab  # noqa: PLC0415 - rarely needed

            complete_at_first_tab(program)


def _command_name(words: list[str]) -> str:
    """Return the first argument; when the shell asks for completions, that of the line to complete."""
    if not _COMPLETING & set(os.environ):
        return words[0] if words else ""
    line = os.environ.get("_TYPER_COMPLETE_ARGS") or os.environ.get("COMP_WORDS", "")
    words = line.split()
    return words[1] if len(words) > 1 else ""


def _app(name: str, program: str, shown: Collection[str] | None) -> typer.Typer:
    """Return the app in which only the named command can run: the help and the other commands start faster."""
    from coframe.cli.commands import COMMANDS, build_app  # noqa: PLC0415 - run() reports a missing typer

    existing = [each for each in COMMANDS if shown is None or each in shown]
    return build_app([name] if name in existing else [], existing, program)


def _what_to_install(error: ModuleNotFoundError) -> str:
    """Return the sentence about a package that is not installed; raise the error again for any other module."""
    package = (error.name or "").partition(".")[0]
    if package in {"typer", "rich"}:
        return "The command line needs the packages typer and rich: pip install 'coframe[cli]'"
    if package not in _EXTRAS:
        raise error
    return f"coframe: This command needs the package {package}: pip install 'coframe[{_EXTRAS[package]}]'"
