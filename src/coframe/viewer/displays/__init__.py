# SPDX-License-Identifier: Apache-2.0
"""Displays: messages converted to drawings. `kinds` has the displays, `rows` the table of all of them."""

from __future__ import annotations

from coframe.viewer.displays._drawing import CannotDrawError, Drawing, Options

__all__ = ["CannotDrawError", "Drawing", "Options"]
