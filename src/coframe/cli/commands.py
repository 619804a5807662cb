"""The commands: each is a function, or an app of its own, of its name in the module of its name."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

import typer

from coframe.cli.new_app import new_app

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["COMMANDS", "app_with"]

# What they do not know is for the node: --ros-args, and arguments of a xacro file.
_NODE = {"context_settings": {"ignore_unknown_options": True, "allow_extra_args": True}}
# How each is registered; `cls` is a name in its module.
COMMANDS: dict[str, dict[str, Any]] = {
    "demo": {},
    "doctor": {},
    "echo": {},
    "frames": {},
    "monitor": {},
    "why": {"cls": "WhyCommand"},
    "view": {},
    "relay": {},
    "lookup": {},
    "trajectory": {},
    "record": {},
    "play": {"cls": "PlayCommand"},
    "cloud": {},
    "batch": {},
    "robot": _NODE,
    "joints": _NODE,
    "bag": {},
    # The numbers of a transform may be negative: it reads its arguments itself.
    "static": {"add_help_option": False, **_NODE},
}


def app_with(names: Iterable[str]) -> typer.Typer:
    """The command line with these commands; only what they need is imported."""
    app = new_app()
    for name in names:
        module = importlib.import_module(f"coframe.cli.{name}")
        options = dict(COMMANDS[name])
        if "cls" in options:
            options["cls"] = getattr(module, options["cls"])
        command = getattr(module, name)
        if isinstance(command, typer.Typer):
            app.add_typer(command, name=name)
        else:
            app.command(**options)(command)
    return app
