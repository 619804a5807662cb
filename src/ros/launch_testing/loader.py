# SPDX-License-Identifier: Apache-2.0
"""Reads the tests and the test descriptions of a module."""

from __future__ import annotations

import functools
import inspect
import unittest
from typing import TYPE_CHECKING, Any

from launch.actions import OpaqueFunction
from launch_testing.actions.ready import ReadyToTest

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping
    from types import ModuleType

    from launch import LaunchDescription

__all__ = ["LoadTestsFromPythonModule", "TestRun", "find_ready_action"]


class TestRun:
    """One launch of a test description, with the tests that run during it and after it.

    Args:
        name: Name of the run.
        test_description_function: Function that returns the launch description, or a tuple of it and a dictionary of
            arguments of the tests.
        param_args: The values of `launch_testing.parametrize`, which are also arguments of the tests.
        pre_shutdown_tests: The tests that run while the processes are running.
        post_shutdown_tests: The tests that run after all processes have ended.
    """

    __test__ = False  # pytest does not collect this class

    def __init__(
        self,
        name: str,
        test_description_function: Callable[..., Any],
        param_args: Mapping[str, Any],
        pre_shutdown_tests: unittest.TestSuite,
        post_shutdown_tests: unittest.TestSuite,
    ) -> None:
        self.name = name
        self.test_description_function = test_description_function
        self.param_args = dict(param_args)
        self.pre_shutdown_tests = pre_shutdown_tests
        self.post_shutdown_tests = post_shutdown_tests

    def __str__(self) -> str:
        return f"{self.name}{_values_as_text(self.param_args)}"

    @property
    def markers(self) -> dict[str, Any]:
        """The marks of the test description."""
        function = self.test_description_function
        if isinstance(function, functools.partial):
            function = function.func
        return dict(getattr(function, "__markers__", {}))

    def normalized_test_description(self, ready_fn: Callable[[], object]) -> tuple[LaunchDescription, dict[str, Any]]:
        """Return the launch description and the arguments that it has for the tests.

        Args:
            ready_fn: Function that is called when the tests may start.

        Raises:
            RuntimeError: The description does not contain exactly one ReadyToTest action.
        """
        function = self.test_description_function
        takes_function = "ready_fn" in inspect.signature(function).parameters
        found = function(ready_fn=ready_fn) if takes_function else function()
        description, arguments = found if isinstance(found, tuple) else (found, {})
        if takes_function:
            return description, dict(arguments)
        ready = find_ready_action(description)
        if ready is None:
            raise RuntimeError(
                "generate_test_description functions without a ready_fn argument must return "
                "LaunchDescription containing a ReadyToTest action"
            )
        ready._add_callback(ready_fn)  # noqa: SLF001 - the same package
        return description, dict(arguments)

    def get_launch_description(self) -> LaunchDescription:
        """Return the launch description."""
        return self.normalized_test_description(lambda: None)[0]

    def all_cases(self) -> Iterator[unittest.TestCase]:
        """Yield all tests."""
        yield from _cases(self.pre_shutdown_tests)
        yield from _cases(self.post_shutdown_tests)

    def bind(
        self,
        tests: unittest.TestSuite,
        injected_attributes: Mapping[str, Any] | None = None,
        injected_args: Mapping[str, Any] | None = None,
    ) -> None:
        """Give values to tests, as attributes and as arguments.

        Args:
            tests: The tests.
            injected_attributes: The attributes, which are also arguments.
            injected_args: Other arguments.
        """
        attributes = dict(injected_attributes or {})
        arguments = {**attributes, **(injected_args or {})}
        for case in _cases(tests):
            for name, value in attributes.items():
                setattr(case, name, value)
            for name in (case._testMethodName, "setUp", "tearDown"):  # noqa: SLF001 - unittest has no public name
                setattr(case, name, _bind_arguments(getattr(case, name), arguments))
        for test_class in {type(case) for case in _cases(tests)}:
            for name in ("setUpClass", "tearDownClass"):
                # The class belongs to this run alone.
                setattr(test_class, name, staticmethod(_bind_arguments(getattr(test_class, name), arguments)))


def LoadTestsFromPythonModule(module: ModuleType, *, name: str = "launch_tests") -> list[TestRun]:
    """Return the runs of a module: one, or one for each value of `launch_testing.parametrize`.

    Args:
        module: The module, which has a function ``generate_test_description``.
        name: Name of the runs.

    Raises:
        AttributeError: There is no such function.
    """
    function = module.generate_test_description
    expand = getattr(function, "__parametrized__", None)
    pairs = expand() if expand is not None else [(function, {})]
    return [TestRun(name, call, values, *_make_suites(module, values)) for call, values in pairs]


def find_ready_action(description: Any) -> ReadyToTest | None:
    """Return the ReadyToTest action of a launch description, at any depth, or None if there is none."""
    pending = [description]
    while pending:
        entity = pending.pop(0)
        if isinstance(entity, ReadyToTest):
            return entity
        if isinstance(entity, OpaqueFunction) or not hasattr(entity, "describe_sub_entities"):
            continue
        pending += entity.describe_sub_entities()
        for _, entities in entity.describe_conditional_sub_entities():
            pending += entities
    return None


def _make_suites(module: ModuleType, values: Mapping[str, Any]) -> tuple[unittest.TestSuite, unittest.TestSuite]:
    """Return the tests before and after the shutdown. Their classes are made for one run."""
    loader = unittest.TestLoader()
    suites = (unittest.TestSuite(), unittest.TestSuite())
    for test_class in _test_classes(module):
        create: Any = type(test_class)
        own = create(test_class.__name__, (test_class,), _own_attributes(test_class, _values_as_text(values)))
        is_after = getattr(test_class, "__post_shutdown_test__", False)
        suites[is_after].addTests(loader.loadTestsFromTestCase(own))
    return suites


def _test_classes(module: ModuleType) -> Iterable[type[unittest.TestCase]]:
    """Yield the test classes that a module defines or imports."""
    bases = {unittest.TestCase, unittest.FunctionTestCase, unittest.IsolatedAsyncioTestCase}
    for each in dict.fromkeys(value for value in vars(module).values() if isinstance(value, type)):
        if issubclass(each, unittest.TestCase) and each not in bases:
            yield each


def _own_attributes(test_class: type[unittest.TestCase], suffix: str) -> dict[str, Any]:
    """Return the attributes of the class of one run: tests with their original names and the values."""

    def case_id(self: unittest.TestCase) -> str:
        return f"{test_class.__module__}.{test_class.__qualname__}.{self._testMethodName}{suffix}"

    def text(self: unittest.TestCase) -> str:
        return f"{self._testMethodName}{suffix} ({test_class.__module__}.{test_class.__qualname__})"

    names = {"__module__": test_class.__module__, "__qualname__": test_class.__qualname__}
    return {**names, "__doc__": test_class.__doc__, "id": case_id, "__str__": text}


def _values_as_text(values: Mapping[str, Any]) -> str:
    return f"[{', '.join(f'{name}={value}' for name, value in values.items())}]" if values else ""


def _cases(suite: unittest.TestSuite) -> Iterator[unittest.TestCase]:
    for each in suite:
        if isinstance(each, unittest.TestSuite):
            yield from _cases(each)
        else:
            yield each


def _bind_arguments(function: Any, arguments: Mapping[str, Any]) -> Any:
    """Bind the arguments that the function accepts."""
    names = inspect.signature(function).parameters
    matching = {name: value for name, value in arguments.items() if name in names}
    return functools.wraps(function)(functools.partial(function, **matching)) if matching else function
