# SPDX-License-Identifier: Apache-2.0
"""Runs files with ``@pytest.mark.launch_test`` or ``@pytest.mark.rostest`` as tests of pytest."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch_testing._pytest_session import require_pytest

require_pytest("launch_testing.pytest")

import pytest

from launch_testing.loader import LoadTestsFromPythonModule
from launch_testing.test_runner import LaunchTestRunner

if TYPE_CHECKING:
    import unittest
    from collections.abc import Iterable, Sequence

    from launch_testing.loader import TestRun

__all__ = ["LaunchTestFailure", "LaunchTestItem"]

_MARKS = ("launch_test", "rostest")


class LaunchTestFailure(Exception):
    """Tests of a launch have failed.

    Args:
        message: What has failed.
        results: The results of the runs.
    """

    def __init__(self, message: str, results: Iterable[unittest.TestResult]) -> None:
        super().__init__(message)
        self._results = list(results)

    def __str__(self) -> str:
        """Return the messages of all failed tests."""
        parts = [str(super().__str__())]
        for result in self._results:
            parts += [f"{case}\n{text}" for case, text in (*result.errors, *result.failures)]
            parts += [f"{case}\nunexpected success" for case in result.unexpectedSuccesses]
        return "\n\n".join(parts)


class LaunchTestItem(pytest.Item):
    """All tests of a file, which run in one launch for each value of `launch_testing.parametrize`.

    Args:
        test_runs: The runs.
        runner_cls: Class of their runner.
        options: Arguments of pytest's items.
    """

    def __init__(self, *, test_runs: Sequence[TestRun], runner_cls: type[LaunchTestRunner], **options: Any) -> None:
        super().__init__(**options)
        self.test_runs = list(test_runs)
        self.runner_cls = runner_cls

    def runtest(self) -> None:
        """Run the tests.

        Raises:
            LaunchTestFailure: Some have failed.
        """
        words = [word for text in self.config.getoption("--launch-args", []) for word in text.split()]
        runner = self.runner_cls(self.test_runs, words, debug=self.config.getoption("verbose") > 1)
        runner.validate()
        results = runner.run()
        if any(not result.wasSuccessful() for result in results.values()):
            raise LaunchTestFailure(f"some test cases have failed in {self.name}", results.values())

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Return the messages of the failed tests, without the traceback of the runner."""
        if isinstance(excinfo.value, LaunchTestFailure):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Any, int | None, str]:
        """Return the place of the tests."""
        return self.path, 0, f"launch tests: {self.name}"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option for the arguments of launches, if pytest is started with ``-p launch_testing``."""
    group = parser.getgroup("launch", "tests of launched systems")
    group.addoption(
        "--launch-args", action="append", default=[], metavar="ARGS", help="arguments of the launch: NAME:=VALUE"
    )


def pytest_configure(config: pytest.Config) -> None:
    """Declare the marks."""
    for mark in _MARKS:
        config.addinivalue_line(
            "markers", f"{mark}: generate_test_description describes the processes of the tests of this file"
        )


@pytest.hookimpl(tryfirst=True)
def pytest_pycollect_makeitem(collector: Any, name: str, obj: Any) -> Any:
    """Collect all tests of a marked file as one item."""
    module = collector.obj if isinstance(collector, pytest.Module) else None
    description = getattr(module, "generate_test_description", None)
    marks = [mark for mark in getattr(description, "pytestmark", []) if mark.name in _MARKS]
    if not marks:
        return None
    if obj is not description or name != "generate_test_description":
        return []  # The item runs them.
    stem = collector.path.stem
    item = LaunchTestItem.from_parent(
        collector, name=stem, test_runs=LoadTestsFromPythonModule(collector.obj, name=stem), runner_cls=LaunchTestRunner
    )
    for mark in description.pytestmark:
        item.add_marker(getattr(pytest.mark, mark.name)(*mark.args, **mark.kwargs))
    return item
