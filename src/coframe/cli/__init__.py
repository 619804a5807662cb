"""The command line: one file a command."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import typer

__all__ = ["main"]


def main() -> None:
    """The console script ``coframe``."""
    try:
        _app(sys.argv[1] if len(sys.argv) > 1 else "")()
    except ModuleNotFoundError as error:
        if error.name not in {"typer", "rich"}:
            raise
        sys.exit(f"coframe: the command line needs the package {error.name}: pip install 'coframe[all]'")
    except KeyboardInterrupt:  # while everything is being loaded
        sys.exit(130)


def _app(name: str) -> typer.Typer:
    """A command by itself starts in half the time; without one that there is, it takes all to say so."""
    from coframe.cli.commands import COMMANDS, app_with  # noqa: PLC0415 - the sentence above must come before it

    return app_with([name] if name in COMMANDS else COMMANDS)
