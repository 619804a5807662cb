"""The command line: one file a command."""

from __future__ import annotations

import importlib
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import typer

__all__ = ["main"]


# Somebody waits for the picture: these start without what the other commands import.
_ALONE = ("view",)


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
    if name not in _ALONE:
        from coframe.cli.app import app  # noqa: PLC0415 - the sentence above must come before what it is about

        return app
    from coframe.cli.new_app import new_app  # noqa: PLC0415 - likewise

    app = new_app()
    app.command()(getattr(importlib.import_module(f"coframe.cli.{name}"), name))
    return app
