"""What all commands hang on."""

from __future__ import annotations

from typing import Annotated

import typer

import coframe

__all__ = ["new_app"]


def new_app() -> typer.Typer:
    """The program ``coframe`` without its commands."""
    app = typer.Typer(
        name="coframe",
        help="ROS 2's transform system (tf2) as one pip install: any frame, any time, on any machine.",
        no_args_is_help=True,
        add_completion=False,
        pretty_exceptions_enable=False,
    )
    app.callback()(_main)
    return app


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"coframe {coframe.__version__}")
        raise typer.Exit


def _main(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and leave.")
    ] = False,
) -> None:
    pass
