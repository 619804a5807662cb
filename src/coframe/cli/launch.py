# SPDX-License-Identifier: Apache-2.0
"""``coframe launch``: runs a launch file, like ``ros2 launch``."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.exceptions import Exit

from coframe._files.existence import exists, is_dir
from coframe._files.os_errors import explain
from coframe._files.regular_files import check_regular, reading_hint
from coframe._output.formatting import did_you_mean
from coframe.cli.declaration import PASS_ARGUMENTS_ON, Command, argument
from coframe.cli.output import fail
from coframe.distributions import current
from coframe.errors import PackageError
from coframe.workspace.packages.executables import module_folders
from coframe.workspace.packages.finding import find_package, use_sources_near

if TYPE_CHECKING:
    from launch import LaunchDescription

__all__ = ["launch"]

_SUFFIXES = (".launch.py", ".launch.xml", ".launch.yaml", ".launch.yml", "_launch.py", "_launch.xml", "_launch.yaml")


@click.command(cls=Command, context_settings=PASS_ARGUMENTS_ON)
@click.pass_context
@argument("package_or_file", metavar="FILE|PACKAGE", help="Launch file, or the package that contains it.")
@click.option("--show-args", "-s", "--show-arguments", is_flag=True, help="Show the arguments of the launch file.")
@click.option(
    "--print",
    "-p",
    "--print-description",
    "print_description",
    is_flag=True,
    help="Print the launch description without launching it.",
)
@click.option("--debug", "-d", is_flag=True, help="Log all events, and include tracebacks in errors.")
@click.option("--noninteractive", "-n", is_flag=True, help="Launch without user interaction.")
@click.option(
    "--launch-prefix",
    metavar="COMMAND",
    default="",
    show_default=False,
    help="Run all processes with this command in front, e.g. 'gdb --args'.",
)
@click.option(
    "--launch-prefix-filter",
    metavar="REGEX",
    default="",
    show_default=False,
    help="Regular expression: use --launch-prefix only for matching processes.",
)
def launch(
    context: click.Context,
    package_or_file: str,
    show_args: bool,
    print_description: bool,
    debug: bool,
    noninteractive: bool,
    launch_prefix: str,
    launch_prefix_filter: str,
) -> None:
    """Launch the nodes of a Python, XML or YAML launch file, like ros2 launch.

    Use coframe launch FILE or coframe launch PACKAGE FILE, followed by launch arguments as NAME:=VALUE. Packages do not
    have to be built. Ctrl-C stops all nodes.

    Example: coframe launch my_robot bringup.launch.py use_sim_time:=true
    """
    words = list(context.args)
    path = _launch_file(package_or_file, words)
    arguments = dict(_argument(word) for word in words)
    if launch_prefix:
        arguments["launch-prefix"] = launch_prefix
    if launch_prefix_filter:
        arguments["launch-prefix-filter"] = launch_prefix_filter
    use_sources_near(path.parent, Path.cwd())
    # Launch files import the modules of packages in the workspace, and read the name of the distribution.
    sys.path += [folder for folder in module_folders() if folder not in sys.path]
    os.environ.setdefault("ROS_DISTRO", current().name.lower())
    if show_args:
        _show_arguments(_description(path))
    elif print_description:
        from launch import LaunchIntrospector  # noqa: PLC0415 - slow import

        print(LaunchIntrospector().format_launch_description(_description(path)))
    else:
        raise Exit(_run(path, arguments, debug=debug, noninteractive=noninteractive))


def _launch_file(package_or_file: str, words: list[str]) -> Path:
    """Return the path of the launch file; remove its name from the arguments if the first one is a package."""
    file = Path(package_or_file)
    if exists(file) and not is_dir(file):
        try:
            check_regular(file)
        except OSError as error:
            fail(f"{package_or_file} cannot be read: {error.strerror}", reading_hint(error))
        return file.resolve()
    if os.sep in package_or_file or package_or_file.endswith(_SUFFIXES):
        siblings = [each.name for each in file.parent.iterdir()] if file.parent.is_dir() else []
        fail(f"No launch file {package_or_file}.", did_you_mean(file.name, siblings, limit=2))
    try:
        share = find_package(package_or_file).share
    except PackageError as error:
        fail(str(error), error.hint)
    there = {each.name: each for each in _files(share) if _is_launch_file(each)}
    if not words or ":=" in words[0]:
        names = ", ".join(there) or "none"
        fail(f"The name of the launch file is missing. Launch files in {package_or_file}: {names}.", code=2)
    name = words.pop(0)
    path = there.get(name, share / name)
    if not path.is_file():
        fail(
            f"No launch file {name!r} in the package {package_or_file!r}.",
            f"{did_you_mean(name, there, limit=2)} Available launch files: {', '.join(there) or 'none'}.".lstrip(),
        )
    return path.resolve()


def _files(folder: Path) -> list[Path]:
    """Return the files below a folder, and below the folders to which the share folder of a source folder links."""
    return sorted(
        Path(root, name)
        for start in [folder, *(each for each in (folder.iterdir() if folder.is_dir() else ()) if each.is_symlink())]
        for root, _, names in os.walk(start)
        for name in names
    )


def _is_launch_file(path: Path) -> bool:
    return path.name.endswith(_SUFFIXES) or (path.parent.name == "launch" and path.suffix in {".py", ".xml", ".yaml"})


def _argument(word: str) -> tuple[str, str]:
    name, separator, value = word.partition(":=")
    if not separator or not name:
        fail(f"malformed launch argument '{word}', expected format '<name>:=<value>'", code=2)
    return name, value


def _description(path: Path) -> LaunchDescription:
    """Return the launch description of a file, with all that it includes."""
    from launch.launch_description_sources import get_launch_description_from_any_launch_file  # noqa: PLC0415

    try:
        return get_launch_description_from_any_launch_file(str(path))
    except Exception as error:  # noqa: BLE001 - a launch file is a program, which may raise anything
        fail(f"{path}: {type(error).__name__}: {explain(error)}", getattr(error, "hint", ""))


def _show_arguments(description: LaunchDescription) -> None:
    arguments = description.get_launch_arguments()
    print("Arguments (pass arguments as '<name>:=<value>'):")
    if not arguments:
        print("\n  No arguments.")
    for each in arguments:
        print(f"\n    '{each.name}':\n        {each.description}")
        if each.default_value is not None:
            default = " + ".join(part.describe() for part in each.default_value)
            print(f"        (default: {default})")


def _run(path: Path, arguments: dict[str, str], *, debug: bool, noninteractive: bool) -> int:
    from launch import LaunchDescription, LaunchService  # noqa: PLC0415 - slow import
    from launch.actions import IncludeLaunchDescription  # noqa: PLC0415
    from launch.launch_description_sources import AnyLaunchDescriptionSource  # noqa: PLC0415
    from launch.logging import get_logger, launch_config  # noqa: PLC0415

    logger = get_logger("launch")
    logger.info("All log files can be found below %s", launch_config.log_dir)
    logger.info("Default logging verbosity is set to %s", "DEBUG" if debug else "INFO")
    argv = [f"{name}:={value}" for name, value in arguments.items()]
    service = LaunchService(argv=argv, noninteractive=noninteractive, debug=debug)
    included = IncludeLaunchDescription(AnyLaunchDescriptionSource(str(path)), launch_arguments=list(arguments.items()))
    service.include_launch_description(LaunchDescription([included]))
    return service.run()
