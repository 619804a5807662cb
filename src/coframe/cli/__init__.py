# SPDX-License-Identifier: Apache-2.0
"""The command line ``coframe``: one module for each command."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from coframe._process.optional_imports import CLI_PACKAGES, extra_of, pip_install
from coframe._process.signal_handlers import SIGINT_EXIT_CODE, clear_handled_interrupt
from coframe.cli.commands import COMMANDS
from coframe.cli.streams import (
    accept_any_encoding,
    discard_output,
    flush_output,
    is_undecodable,
    replace_closed_streams,
)
from coframe.cli.system_errors import description

if TYPE_CHECKING:
    from collections.abc import Collection

__all__ = ["main", "run"]


def main() -> None:
    """Run the console script ``coframe``."""
    run(sys.argv[1:])


def run(words: list[str], *, program: str = "coframe", shown: Collection[str] | None = None) -> None:
    """Run a command line and end the process.

    Args:
        words: The arguments.
        program: The name of the program in its help.
        shown: The available commands. None for all.
    """
    replace_closed_streams()
    accept_any_encoding()
    if bad := next(filter(is_undecodable, words), None):
        print(f"coframe: the argument {bad[:60]!r} is not valid UTF-8.", file=sys.stderr)
        sys.exit(2)
    try:
        try:
            from coframe.cli.command_line import CommandLine  # noqa: PLC0415 - a missing click is reported below

            CommandLine(program, shown)(words, prog_name=program)
        finally:
            flush_output()
    except ModuleNotFoundError as error:
        sys.exit(_missing_package_message(error, words))
    except KeyboardInterrupt:  # Ctrl-C during the imports.
        sys.exit(SIGINT_EXIT_CODE)
    except BrokenPipeError:  # The reader of a pipe, such as `head`, closed it.
        discard_output()
        sys.exit(1)
    except OSError as error:
        discard_output()
        sys.exit(description(error))
    finally:
        clear_handled_interrupt()


def _missing_package_message(error: ModuleNotFoundError, words: list[str]) -> str:
    """Return the message about a missing package; re-raise the error for any other module."""
    package = (error.name or "").partition(".")[0]
    if package in CLI_PACKAGES:
        return f"The command line needs the packages {' and '.join(CLI_PACKAGES)}: {pip_install('cli')}"
    extras = COMMANDS[words[0]].extras if words and words[0] in COMMANDS else ()
    extra = extra_of(package, extras)
    if extra is None:
        raise error
    return f"coframe: This command needs the package {package}: {pip_install(extra)}"
