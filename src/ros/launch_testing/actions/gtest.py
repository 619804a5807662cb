# SPDX-License-Identifier: Apache-2.0
"""The action that runs a test program of GoogleTest."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from launch_testing.actions.test import Test

__all__ = ["GTest"]


class GTest(Test):
    """Run a test program of GoogleTest, which writes its results below ``test_results``.

    Args:
        path: The program.
        timeout: Seconds after which it is stopped, or None for no limit.
        options: Keyword arguments of ExecuteProcess.
    """

    def __init__(self, *, path: Any, timeout: float | None = None, **options: Any) -> None:
        output = Path("test_results", f"{Path(str(path)).stem}.gtest.xml")
        super().__init__(cmd=[path, f"--gtest_output=xml:{output}"], timeout=timeout, **options)
