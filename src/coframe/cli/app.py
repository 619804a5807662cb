# SPDX-License-Identifier: Apache-2.0
"""The command line with all commands."""

from __future__ import annotations

from coframe.cli.commands import COMMANDS, build_app

__all__ = ["app"]

app = build_app(COMMANDS)
