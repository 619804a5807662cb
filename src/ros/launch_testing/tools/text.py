# SPDX-License-Identifier: Apache-2.0
"""Matchers for text and lines."""

from launch_testing._matching import build_line_match, build_text_match, remove_ansi_escape_sequences

__all__ = ["build_line_match", "build_text_match", "remove_ansi_escape_sequences"]
