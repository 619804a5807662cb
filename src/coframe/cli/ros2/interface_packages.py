# SPDX-License-Identifier: Apache-2.0
"""The commands of ``coframe interface`` about the user's packages: ``add``, ``check``, ``remove`` and ``stubs``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click
from click.exceptions import Exit

from coframe._output.formatting import count, join_names
from coframe.cli.declaration import PATH, Command, argument
from coframe.cli.output import fail, printable, warn
from coframe.errors import InterfaceError
from coframe.interfaces.sources import ENVIRONMENT, InterfaceFolder, package_folders, sources
from coframe.interfaces.user_folders import added_paths, set_added_paths, settings_file, stub_folder
from coframe.interfaces.workspace import add_start_folder
from coframe.messages.packages import forget, load_package, shipped_names
from coframe.messages.stub_files import write_stubs

if TYPE_CHECKING:
    from pathlib import Path

    from coframe.messages.packages import InterfacePackage

__all__ = ["add", "check", "remove", "stubs"]

folder_argument = argument(
    "path", metavar="FOLDER", type=PATH, help="Folder of a package, or a folder with packages, such as a src folder."
)
program_folder = argument(
    "folder",
    metavar="[FOLDER]",
    type=PATH,
    required=False,
    help="Folder of a program: also include the packages that it would find.",
)


@click.command(cls=Command, short_help="Show and check your interface packages.")
@program_folder
def check(folder: Path | None) -> None:
    """Show your interface packages, where they were found, and problems in their definitions.

    Programs also find packages next to themselves and in their workspace; pass the FOLDER of a program to include
    these. The exit code is 1 if a definition is invalid.

    Example: coframe interface check .
    """
    _search_from(folder)
    errors: list[InterfaceError] = []
    found: dict[str, Path] = {}
    for source in sources():
        for name, path in _packages_in(source).items():
            if name in found:
                continue
            found[name] = path
            click.echo(printable(f"{name}: {_content_text(load_package(name, path))}, in {path} ({source.origin})"))
            errors += _find_invalid(load_package(name, path))
    if not found:
        searched = list(dict.fromkeys(printable(f"\n  {source.folder}") for source in sources()))
        click.echo("None of your packages were found. Searched:" + ("".join(searched) or " no folder"))
        click.echo(
            f"Run `coframe interface check FOLDER` to include the packages that a program would find, or set "
            f"{ENVIRONMENT}."
        )
        click.echo("Run `coframe interface add FOLDER` to add a folder for all programs and commands.")
    click.echo(f"coframe contains {', '.join(name for name in shipped_names() if name not in found)}.")
    _report(errors)


@click.command(cls=Command, short_help="Add a folder to the search path of all programs.")
@folder_argument
def add(path: Path) -> None:
    """Add FOLDER to the search path of all programs for interface packages, and write stubs for editors.

    Example: coframe interface add ~/ros2_ws/src/my_msgs
    """
    folder = path.expanduser().absolute()
    _require_folder(folder)
    found = package_folders(InterfaceFolder("", folder, 8))
    if not found:
        fail(
            f"no package with .msg, .srv, .action or .idl files in {folder}",
            "A package is a folder with these files in folders named msg, srv and action.",
        )
    try:
        set_added_paths(list(dict.fromkeys([*added_paths(), folder])))
    except OSError as error:
        fail(f"{settings_file()} cannot be written: {error.strerror}")
    forget()
    packages = [load_package(name, found[name]) for name in sorted(found)]
    for package in packages:
        click.echo(printable(f"{package.name}: {_content_text(package)}, in {package.folder}"))
    errors = [error for package in packages for error in _find_invalid(package)]
    _write_stubs(packages, stub_folder())
    _report(errors)


@click.command(cls=Command, short_help="Remove a folder from the search path.")
@folder_argument
def remove(path: Path) -> None:
    """Remove a folder that was added to the search path.

    Example: coframe interface remove ~/ros2_ws/src/my_msgs
    """
    folder = path.expanduser().absolute()
    added = added_paths()
    if folder not in added:
        fail(
            f"{folder} was not added",
            f"Added: {join_names(list(map(str, added)))}." if added else "No folder was added.",
        )
    try:
        set_added_paths([other for other in added if other != folder])
    except OSError as error:
        fail(f"{settings_file()} cannot be written: {error.strerror}")


@click.command(cls=Command, short_help="Write stubs of your messages for editors.")
@program_folder
@click.option(
    "--output", metavar="FOLDER", type=PATH, help="Folder to write to. [default: a folder in the user's cache]"
)
def stubs(folder: Path | None, output: Path | None) -> None:
    """Write stub files of your packages, which show the fields of each class to editors and type checkers.

    Pylance and pyright find a folder named typings in the project automatically. Run the command again after you change
    a definition.

    Example: coframe interface stubs . --output typings
    """
    _search_from(folder)
    found: dict[str, Path] = {}
    for source in sources():
        for name, path in _packages_in(source).items():
            found.setdefault(name, path)
    if not found:
        fail(
            "none of your packages were found",
            "Give the folder of the program that uses them: coframe interface stubs FOLDER.",
        )
    _report(_write_stubs([load_package(name, found[name]) for name in sorted(found)], output or stub_folder()))


def _search_from(folder: Path | None) -> None:
    if folder is None:
        return
    _require_folder(folder.expanduser())
    add_start_folder(folder.expanduser())


def _require_folder(path: Path) -> None:
    """End the command if a path is not a folder."""
    hint = "Give the folder of a program or of an interface package, such as '.'."
    if path.is_dir():
        return
    if path.is_file():
        fail(f"{path} is a file, not a folder.", hint)
    if path.exists():
        fail(f"{path} is a device, a pipe or a socket, not a folder.", hint)
    above = next((parent for parent in path.absolute().parents if parent.is_dir()), path.parent)
    fail(f"There is no folder {path}.", f"{hint} The part that exists is {above}.")


def _packages_in(source: InterfaceFolder) -> dict[str, Path]:
    return dict(sorted(package_folders(source).items()))


def _content_text(package: InterfacePackage) -> str:
    return ", ".join(f"{len(package.names(kind))} {kind}" for kind in package.kinds())


def _find_invalid(package: InterfacePackage) -> list[InterfaceError]:
    errors: list[InterfaceError] = []
    for kind in package.kinds():
        for name in package.names(kind):
            try:
                package.create(kind, name)
            except InterfaceError as error:
                errors.append(error)
    return errors


def _write_stubs(packages: list[InterfacePackage], folder: Path) -> list[InterfaceError]:
    errors: list[InterfaceError] = []
    try:
        for package in packages:
            errors += write_stubs(package, folder)
    except OSError as error:
        fail(f"the stubs cannot be written into {folder}: {error.strerror}")
    click.echo(f"Stubs of {count(len(packages), 'package')} written into {folder}")
    click.echo('Settings: "python.analysis.extraPaths" in VS Code, extraPaths of pyright, mypy_path of mypy.')
    return errors


def _report(errors: list[InterfaceError]) -> None:
    for text in dict.fromkeys(f"{error}" + (f" ({error.hint})" if error.hint else "") for error in errors):
        warn(text)
    if errors:
        raise Exit(1)
