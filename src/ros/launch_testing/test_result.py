# SPDX-License-Identifier: Apache-2.0
"""Results of the tests of a launch."""

from __future__ import annotations

import time
import unittest
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from launch_testing.loader import TestRun

__all__ = ["FailResult", "SkipResult", "TestResult"]


class TestResult(unittest.TextTestResult):
    """The result of unittest, with the duration of each test."""

    __test__ = False  # pytest does not collect this class

    def __init__(self, stream: Any = None, descriptions: Any = None, verbosity: Any = 1, **options: Any) -> None:
        super().__init__(stream, descriptions, verbosity, **options)
        self.testCases: list[unittest.TestCase] = []
        self.testTimes: dict[unittest.TestCase, float] = {}
        self._started = 0.0

    def startTest(self, test: unittest.TestCase) -> None:
        """Start the timer of a test."""
        self.testCases.append(test)
        self._started = time.monotonic()
        super().startTest(test)

    def stopTest(self, test: unittest.TestCase) -> None:
        """Stop the timer of a test."""
        self.testTimes[test] = time.monotonic() - self._started
        super().stopTest(test)

    def append(self, results: unittest.TestResult) -> None:
        """Add the results of other tests."""
        for name in ("failures", "errors", "skipped", "expectedFailures", "unexpectedSuccesses"):
            getattr(self, name).extend(getattr(results, name))
        self.testsRun += results.testsRun
        self.testCases += getattr(results, "testCases", [])
        self.testTimes |= getattr(results, "testTimes", {})


class _ResultWithoutTests(unittest.TestResult):
    """A result of a run whose tests have not run."""

    def __init__(self, test_run: TestRun, message: str) -> None:
        super().__init__()
        self._test_run = test_run
        self._message = message
        cases: list[Any] = list(test_run.all_cases())
        self.testCases = cases
        self.testTimes = dict.fromkeys(cases, 0.0)

    @property
    def message(self) -> str:
        """Why no test has run."""
        return self._message


class FailResult(_ResultWithoutTests):
    """A failure of all tests of a run.

    Args:
        test_run: The run.
        message: What has failed.
    """

    def __init__(self, test_run: TestRun, message: str = "") -> None:
        super().__init__(test_run, message)
        self.failures += [(case, message) for case in self.testCases]

    def wasSuccessful(self) -> bool:
        """Return False, even if the run has no tests."""
        return False


class SkipResult(_ResultWithoutTests):
    """A run whose tests are skipped.

    Args:
        test_run: The run.
        skip_reason: Why.
    """

    def __init__(self, test_run: TestRun, skip_reason: str = "") -> None:
        super().__init__(test_run, skip_reason)
        self.skipped += [(case, skip_reason) for case in self.testCases]
