"""All commands together."""

from __future__ import annotations

from typing import Annotated

import typer

import coframe
from coframe.cli.bag import bag
from coframe.cli.demo import demo
from coframe.cli.doctor import doctor
from coframe.cli.echo import echo
from coframe.cli.lookup import lookup
from coframe.cli.monitor import monitor
from coframe.cli.robot import robot
from coframe.cli.static import static
from coframe.cli.trajectory import trajectory
from coframe.cli.view import view

__all__ = ["app"]

app = typer.Typer(
    name="coframe",
    help="ROS 2's transform system (tf2) as one pip install: any frame, any time, on any machine.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"coframe {coframe.__version__}")
        raise typer.Exit


@app.callback()
def _main(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and leave.")
    ] = False,
) -> None:
    pass


app.command()(demo)
app.command()(doctor)
app.command()(echo)
app.command()(monitor)
app.command()(view)
app.command()(lookup)
app.command()(trajectory)
app.command(context_settings={"ignore_unknown_options": True, "allow_extra_args": True})(robot)
app.add_typer(bag, name="bag")
# The numbers of a transform may be negative: this command reads its arguments itself.
app.command(add_help_option=False, context_settings={"ignore_unknown_options": True, "allow_extra_args": True})(static)
