# SPDX-License-Identifier: Apache-2.0
"""The commands of ``coframe interface`` about the user's packages: ``add``, ``check``, ``remove`` and ``stubs``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click
from click.exceptions import Exit

from coframe._output.formatting import count, listed
from coframe.cli.declaration import PATH, Command, argument
from coframe.cli.output import fail, printable, warn
from coframe.errors import InterfaceError
from coframe.interfaces.sources import ENVIRONMENT, Source, package_folders, sources
from coframe.interfaces.user_folders import added_paths, set_added_paths, settings_file, stub_folder
from coframe.interfaces.workspace import add_start
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
    help="Folder of a program: also show what the program finds there.",
)


@click.command(cls=Command, short_help="Show your packages and where they were found; check them.")
@program_folder
def check(folder: Path | None) -> None:
    """Show your interface packages, where they were found, and what is wrong with their definitions.

    Programs also find packages next to them and in their workspace: give the FOLDER of the program. The exit code is 1
    if a definition is invalid.

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
            click.echo(printable(f"{name}: {_content(load_package(name, path))}, in {path} ({source.origin})"))
            errors += _invalid(load_package(name, path))
    if not found:
        searched = list(dict.fromkeys(printable(f"\n  {source.folder}") for source in sources()))
        click.echo("No packages of yours were found. Searched:" + ("".join(searched) or " no folder"))
        click.echo(f"Show those of a program with `coframe interface check FOLDER`, or set {ENVIRONMENT}.")
        click.echo("Add a folder for all programs and commands with `coframe interface add FOLDER`.")
    click.echo(f"coframe contains {', '.join(name for name in shipped_names() if name not in found)}.")
    _report(errors)


@click.command(cls=Command, short_help="Search a folder in every program from now on.")
@folder_argument
def add(path: Path) -> None:
    """Search FOLDER for interface packages in every program from now on, and write stubs for editors.

    Example: coframe interface add ~/ros2_ws/src/my_msgs
    """
    folder = path.expanduser().absolute()
    if not folder.is_dir():
        fail(f"no folder {folder}")
    found = package_folders(Source("", folder, 8))
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
        click.echo(printable(f"{package.name}: {_content(package)}, in {package.folder}"))
    errors = [error for package in packages for error in _invalid(package)]
    _write_stubs(packages, stub_folder())
    _report(errors)


@click.command(cls=Command, short_help="Stop searching an added folder.")
@folder_argument
def remove(path: Path) -> None:
    """Stop searching a folder that was added.

    Example: coframe interface remove ~/ros2_ws/src/my_msgs
    """
    folder = path.expanduser().absolute()
    added = added_paths()
    if folder not in added:
        fail(f"{folder} was not added", f"Added: {listed(list(map(str, added)))}." if added else "No folder was added.")
    try:
        set_added_paths([other for other in added if other != folder])
    except OSError as error:
        fail(f"{settings_file()} cannot be written: {error.strerror}")


@click.command(cls=Command, short_help="Write stubs, so that editors know your messages.")
@program_folder
@click.option("--output", metavar="FOLDER", type=PATH, help="Folder to write; default: a folder of the user's cache.")
def stubs(folder: Path | None, output: Path | None) -> None:
    """Write stub files of your packages, so that editors and type checkers know the fields of each class.

    Pylance and pyright search a folder named typings in the project without any setting. Run the command again after
    you have changed a definition.

    Example: coframe interface stubs . --output typings
    """
    _search_from(folder)
    found: dict[str, Path] = {}
    for source in sources():
        for name, path in _packages_in(source).items():
            found.setdefault(name, path)
    if not found:
        fail(
            "no packages of yours were found",
            "Give the folder of the program that uses them: coframe interface stubs FOLDER.",
        )
    _report(_write_stubs([load_package(name, found[name]) for name in sorted(found)], output or stub_folder()))


def _search_from(folder: Path | None) -> None:
    if folder is None:
        return
    if not folder.expanduser().is_dir():
        fail(f"no folder {folder}")
    add_start(folder.expanduser())


def _packages_in(source: Source) -> dict[str, Path]:
    return dict(sorted(package_folders(source).items()))


def _content(package: InterfacePackage) -> str:
    return ", ".join(f"{len(package.names(kind))} {kind}" for kind in package.kinds())


def _invalid(package: InterfacePackage) -> list[InterfaceError]:
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
