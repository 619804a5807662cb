# SPDX-License-Identifier: Apache-2.0
"""The command line with all commands of coframe imported, for documentation and tests."""

from __future__ import annotations

import click

from coframe.cli.command_line import CommandLine
from coframe.cli.commands import COMMANDS

__all__ = ["app"]

app = CommandLine()
for _name in COMMANDS:
    app.get_command(click.Context(app), _name)
