"""All commands together."""

from __future__ import annotations

from coframe.cli.commands import COMMANDS, app_with

__all__ = ["app"]

app = app_with(COMMANDS)
