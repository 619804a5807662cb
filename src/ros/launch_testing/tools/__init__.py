# SPDX-License-Identifier: Apache-2.0
"""Tools for tests that start processes themselves and examine their output."""

from launch_testing.tools.output import (
    basic_output_filter,
    expect_output,
    get_default_filtered_patterns,
    get_default_filtered_prefixes,
)
from launch_testing.tools.process import ProcessProxy, launch_process

__all__ = [
    "ProcessProxy",
    "basic_output_filter",
    "expect_output",
    "get_default_filtered_patterns",
    "get_default_filtered_prefixes",
    "launch_process",
]
