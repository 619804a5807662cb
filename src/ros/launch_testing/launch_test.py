# SPDX-License-Identifier: Apache-2.0
"""The command ``launch_test``, which runs the tests of a file."""

from __future__ import annotations

import argparse
import importlib.util
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from launch_testing.junitxml import unittestResultsToXml
from launch_testing.loader import LoadTestsFromPythonModule
from launch_testing.print_arguments import print_arguments_of_launch_description
from launch_testing.test_runner import LaunchTestRunner

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import ModuleType

__all__ = ["add_arguments", "main", "parse_arguments", "run"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to a parser."""
    parser.add_argument("test_file", help="file with generate_test_description and the tests")
    parser.add_argument("launch_arguments", nargs="*", help="arguments of the launch: '<name>:=<value>'")
    parser.add_argument("-v", "--verbose", action="store_true", help="log all events of the launch")
    parser.add_argument("-s", "--show-args", "--show-arguments", action="store_true", help="show the launch arguments")
    parser.add_argument("--package-name", help="name of the package, which is part of the names in the results")
    parser.add_argument("--junit-xml", metavar="FILE", help="write the results to an XML file")


def parse_arguments(
    words: Sequence[str] | None = None, program: str = "launch_test"
) -> tuple[argparse.ArgumentParser, argparse.Namespace]:
    """Return the parser of the command and the parsed arguments."""
    parser = argparse.ArgumentParser(program, description="Run the tests of a launched system.")
    add_arguments(parser)
    return parser, parser.parse_args(words)


def run(
    parser: argparse.ArgumentParser,
    arguments: argparse.Namespace,
    test_runner_cls: type[LaunchTestRunner] = LaunchTestRunner,
) -> int:
    """Run the tests, and return the exit code: 0 if all have passed, 1 if not.

    Args:
        parser: The parser, which reports wrong arguments.
        arguments: The arguments.
        test_runner_cls: Class of the runner.
    """
    path = Path(arguments.test_file)
    if not path.is_file():
        parser.error(f"Test file '{path}' does not exist")
    if wrong := next((word for word in arguments.launch_arguments if ":=" not in word[1:]), None):
        parser.error(f"malformed launch argument '{wrong}', expected format '<name>:=<value>'")
    module = _import(parser, path)
    if not hasattr(module, "generate_test_description"):
        parser.error(f"Test file '{path}' is missing generate_test_description function")
    name = f"{arguments.package_name}.{path.stem}.launch_tests" if arguments.package_name else "launch_tests"
    runs = LoadTestsFromPythonModule(module, name=name)
    runner = test_runner_cls(runs, arguments.launch_arguments, arguments.verbose)
    try:
        runner.validate()
    except Exception as error:  # noqa: BLE001 - the description is a function of the user
        parser.error(f"Test file '{path}': {type(error).__name__}: {error}")
    if arguments.show_args:
        print_arguments_of_launch_description(launch_description=runs[0].get_launch_description())
        return 0
    results = runner.run()
    if arguments.junit_xml:
        report = Path(arguments.junit_xml)
        report.parent.mkdir(parents=True, exist_ok=True)
        unittestResultsToXml(name=name, test_results=results).write(report, encoding="utf-8", xml_declaration=True)
    return 0 if all(result.wasSuccessful() for result in results.values()) else 1


def main(words: Sequence[str] | None = None, program: str = "launch_test") -> int:
    """Run the command, and return its exit code."""
    parser, arguments = parse_arguments(words, program)
    return run(parser, arguments)


def _import(parser: argparse.ArgumentParser, path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(path.name.partition(".")[0], path)
    if spec is None or spec.loader is None:
        parser.error(f"Test file '{path}' is not a Python file: its name must end in .py")
    module = importlib.util.module_from_spec(spec)
    sys.path.insert(0, str(path.parent.resolve()))
    sys.modules[spec.name] = module
    try:
        spec.loader.exec_module(module)
    except Exception as error:  # noqa: BLE001 - a test file may raise anything
        parser.error(f"Test file '{path}' cannot be imported: {type(error).__name__}: {error}")
    return module


if __name__ == "__main__":
    sys.exit(main())
