"""The command line: one file a command."""

from __future__ import annotations

import sys

__all__ = ["main"]


def main() -> None:
    """The console script ``coframe``."""
    try:
        from coframe.cli.app import app  # noqa: PLC0415 - the sentence below must come before what it is about
    except ModuleNotFoundError as error:
        if error.name not in {"typer", "rich"}:
            raise
        sys.exit(f"coframe: the command line needs the package {error.name}: pip install 'coframe[all]'")
    except KeyboardInterrupt:  # while everything is being loaded
        sys.exit(130)
    app()
