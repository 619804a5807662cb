# SPDX-License-Identifier: Apache-2.0
"""The action that runs tests of pytest in a process."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from coframe._process.python_children import python_command
from launch_testing.actions.test import Test

__all__ = ["PyTest"]


class PyTest(Test):
    """Run a file of tests with pytest, which writes its results below ``test_results``.

    Args:
        path: The file.
        timeout: Seconds after which it is stopped, or None for no limit.
        options: Keyword arguments of ExecuteProcess.
    """

    def __init__(self, *, path: Any, timeout: float | None = None, **options: Any) -> None:
        output = Path("test_results", f"{Path(str(path)).stem}.xunit.xml")
        super().__init__(cmd=[*python_command("pytest"), path, f"--junit-xml={output}"], timeout=timeout, **options)
