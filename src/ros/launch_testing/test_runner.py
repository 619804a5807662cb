# SPDX-License-Identifier: Apache-2.0
"""Launches test descriptions and runs their tests."""

from __future__ import annotations

import inspect
import sys
import threading
import unittest
from typing import TYPE_CHECKING, Any

from launch import LaunchDescription, LaunchDescriptionSource, LaunchService
from launch.actions import IncludeLaunchDescription, RegisterEventHandler
from launch.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart
from launch_testing.io_handler import ActiveIoHandler, IoHandler
from launch_testing.proc_info_handler import ActiveProcInfoHandler, ProcInfoHandler
from launch_testing.test_result import FailResult, TestResult

if TYPE_CHECKING:
    from collections.abc import Sequence

    from launch.action import Action
    from launch.events.process import ProcessStarted
    from launch_testing.loader import TestRun

__all__ = ["LaunchTestRunner"]

_STARTUP_TIMEOUT = 15.0  # seconds until ReadyToTest
_END_OF_TESTS = 1.0  # seconds in which a test that was waiting may notice the end of the launch
_SEPARATOR = "#" * 30


class LaunchTestRunner:
    """Runs the tests of a file, with one launch at a time.

    Args:
        test_runs: The runs.
        launch_file_arguments: Arguments of the launch, such as ``["rate:=2"]``.
        debug: Log all events of the launch.
    """

    def __init__(
        self, test_runs: Sequence[TestRun], launch_file_arguments: Sequence[str] = (), debug: bool = False
    ) -> None:
        self._test_runs = list(test_runs)
        self._launch_file_arguments = list(launch_file_arguments)
        self._debug = debug

    def generate_preamble(self) -> list[Action]:
        """Return actions that are executed before each test description; subclasses override it."""
        return []

    def run(self) -> dict[TestRun, unittest.TestResult]:
        """Run all tests, and return the result of each run."""
        return {run: self._run(run) for run in self._test_runs}

    def validate(self) -> None:
        """Check the test descriptions without launching them.

        Raises:
            Exception: A function ``generate_test_description`` has arguments that do not exist, or fails.
        """
        for run in self._test_runs:
            _check_arguments(run)
            run.normalized_test_description(lambda: None)

    def _run(self, test_run: TestRun) -> unittest.TestResult:
        worker = _Worker(test_run, self.generate_preamble(), self._launch_file_arguments, self._debug)
        return worker.run()


class _Worker:
    """One launch: the launch service runs in this thread, the tests in another one."""

    def __init__(self, test_run: TestRun, preamble: list[Action], arguments: list[str], debug: bool) -> None:
        self._test_run = test_run
        self._preamble = preamble
        self._arguments = [_argument(word) for word in arguments]
        self._service = LaunchService(argv=arguments, debug=debug)
        self._proc_info = ActiveProcInfoHandler()
        self._proc_output = ActiveIoHandler()
        self._ready = threading.Event()
        self._result: TestResult | None = None
        self._error: BaseException | None = None

    def run(self) -> unittest.TestResult:
        description, context = self._test_run.normalized_test_description(self._ready.set)
        shared = {"test_args": dict(self._arguments), **self._test_run.param_args, **context}
        active = {"proc_info": self._proc_info, "proc_output": self._proc_output, "launch_service": self._service}
        self._test_run.bind(self._test_run.pre_shutdown_tests, active, shared)
        self._service.include_launch_description(
            LaunchDescription(
                [
                    *self._preamble,
                    *self._listeners(),
                    IncludeLaunchDescription(
                        LaunchDescriptionSource(launch_description=description), launch_arguments=self._arguments
                    ),
                ]
            )
        )
        tests = threading.Thread(target=self._run_tests, daemon=True)
        tests.start()
        self._service.run(shutdown_when_idle=not self._test_run.markers.get("keep_alive", False))
        is_ready = self._ready.is_set()
        self._ready.set()  # The thread must not wait any longer.
        tests.join(_END_OF_TESTS)
        if self._error is not None:
            raise self._error
        if self._result is None or not is_ready:
            return self._failed_launch("Processes under test stopped before tests completed")
        self._run_tests_after_shutdown(shared)
        return self._result

    def _listeners(self) -> list[Action]:
        def on_start(event: ProcessStarted, _: Any) -> None:
            self._proc_info.append(event)
            self._proc_output.track(event.process_name, event.action)

        def on_exit(event: Any, _: Any) -> None:
            self._proc_info.append(event)

        def on_output(event: Any) -> None:
            self._proc_output.append(event)

        return [
            RegisterEventHandler(OnProcessStart(on_start=on_start)),
            RegisterEventHandler(OnProcessExit(on_exit=on_exit)),
            RegisterEventHandler(OnProcessIO(on_stdout=on_output, on_stderr=on_output)),
        ]

    def _run_tests(self) -> None:
        try:
            if not self._ready.wait(_STARTUP_TIMEOUT):
                print(f"Timed out waiting for processes to start up after {_STARTUP_TIMEOUT:g} s", file=sys.stderr)
            elif not self._service.context.is_shutdown:
                self._result = _run_suite(self._test_run.pre_shutdown_tests)
        except BaseException as error:  # noqa: BLE001 - it is raised in the main thread
            self._error = error
        finally:
            self._service.shutdown()

    def _run_tests_after_shutdown(self, shared: dict[str, Any]) -> None:
        assert self._result is not None
        info, output = ProcInfoHandler(), IoHandler()
        for event in self._proc_info:
            info.append(event)
            output.track(event.process_name, event.action)
        for text in self._proc_output:
            output.append(text)
        self._test_run.bind(
            self._test_run.post_shutdown_tests, {"proc_info": info, "proc_output": output, "test_args": {}}, shared
        )
        self._result.append(_run_suite(self._test_run.post_shutdown_tests))

    def _failed_launch(self, message: str) -> FailResult:
        """Return the failure of a launch that has ended too early, and print the output of its processes."""
        print(f"\n{message}", file=sys.stderr)
        for event in self._proc_info:
            code = getattr(event, "returncode", None)
            state = "did not exit" if code is None else f"exited with {code}"
            print(f"Process '{event.process_name}' {state}", file=sys.stderr)
        for name in self._proc_output.process_names():
            text = b"".join(each.text for each in self._proc_output[name]).decode(errors="replace")
            print(f"##### '{name}' output #####\n{text}\n{_SEPARATOR}", file=sys.stderr)
        return FailResult(self._test_run, message)


def _run_suite(suite: unittest.TestSuite) -> TestResult:
    runner = unittest.TextTestRunner(verbosity=2, resultclass=TestResult)
    result = runner.run(suite)
    assert isinstance(result, TestResult)
    return result


def _argument(word: str) -> tuple[str, str]:
    name, separator, value = word.partition(":=")
    if not separator or not name:
        raise RuntimeError(f"malformed launch argument '{word}', expected format '<name>:=<value>'")
    return name, value


def _check_arguments(run: TestRun) -> None:
    unknown = [
        name
        for name, parameter in inspect.signature(run.test_description_function).parameters.items()
        if name != "ready_fn" and name not in run.param_args and parameter.default is parameter.empty
    ]
    if unknown:
        raise TypeError(
            f"generate_test_description has unexpected extra argument '{unknown[0]}': its arguments are ready_fn and "
            "those of launch_testing.parametrize"
        )
