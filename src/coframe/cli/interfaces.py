# SPDX-License-Identifier: Apache-2.0
"""``coframe interfaces``: the user's packages with messages, services and actions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click
from click.exceptions import Exit

from coframe.cli.declaration import PATH, CommandGroup, argument
from coframe.cli.output import fail, printable, warn
from coframe.errors import InterfaceError
from coframe.formatting import count, listed
from coframe.interfaces.sources import ENVIRONMENT, Source, package_folders, sources
from coframe.interfaces.user_folders import added_paths, set_added_paths, settings_file, stub_folder
from coframe.interfaces.workspace import add_start
from coframe.messages.packages import find_package, forget, load_package, shipped_names
from coframe.messages.registry import find
from coframe.messages.stub_files import write_stubs
from coframe.messages.type_hash import type_hash

if TYPE_CHECKING:
    from pathlib import Path

    from coframe.messages.packages import InterfacePackage

__all__ = ["interfaces"]

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
interfaces = CommandGroup(
    "interfaces",
    help=(
        "Find, check and add your own .msg, .srv, .action and .idl files.\n\n"
        "Example: coframe interfaces add ~/ros2_ws/src/my_msgs"
    ),
)


@interfaces.command("list", short_help="Show your packages and where they were found; check them.")
@program_folder
def list_packages(folder: Path | None) -> None:
    """Show your interface packages, where they were found, and what is wrong with their definitions.

    Programs also find packages next to them and in their workspace: give the FOLDER of the program. The exit code is 1
    if a definition is invalid.

    Example: coframe interfaces list .
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
        click.echo(f"Show those of a program with `coframe interfaces list FOLDER`, or set {ENVIRONMENT}.")
        click.echo("Add a folder for all programs and commands with `coframe interfaces add FOLDER`.")
    click.echo(f"coframe contains {', '.join(name for name in shipped_names() if name not in found)}.")
    _report(errors)


@interfaces.command(short_help="Show a definition, and the file that it is in.")
@argument("name", metavar="NAME", help="A type, such as std_msgs/msg/Header, or a package.")
def show(name: str) -> None:
    """Show the definition of a message, service or action, or the types of a package.

    Example: coframe interfaces show std_msgs/msg/Header
    """
    package_name, _, rest = name.partition("/")
    package = find_package(package_name)
    if package is None:
        fail(f"no package {package_name}", "See all packages with `coframe interfaces list`.")
    types = [f"{kind}/{own}" for kind in package.kinds() for own in package.names(kind)]
    if not rest:
        click.echo("\n".join(f"{package_name}/{own}" for own in types))
        return
    matching = [own for own in types if rest in {own, own.partition("/")[2]}]
    if not matching:
        fail(f"no type {name}", f"The package has {listed([f'{package_name}/{own}' for own in types])}.")
    for own in matching:
        _show(package, own)


@interfaces.command(short_help="Search a folder in every program from now on.")
@folder_argument
def add(path: Path) -> None:
    """Search FOLDER for interface packages in every program from now on, and write stubs for editors.

    Example: coframe interfaces add ~/ros2_ws/src/my_msgs
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


@interfaces.command(short_help="Stop searching an added folder.")
@folder_argument
def remove(path: Path) -> None:
    """Stop searching a folder that was added.

    Example: coframe interfaces remove ~/ros2_ws/src/my_msgs
    """
    folder = path.expanduser().absolute()
    added = added_paths()
    if folder not in added:
        fail(f"{folder} was not added", f"Added: {listed(list(map(str, added)))}." if added else "No folder was added.")
    try:
        set_added_paths([other for other in added if other != folder])
    except OSError as error:
        fail(f"{settings_file()} cannot be written: {error.strerror}")


@interfaces.command(short_help="Write stubs, so that editors know your messages.")
@program_folder
@click.option("--output", metavar="FOLDER", type=PATH, help="Folder to write; default: a folder of the user's cache.")
def stubs(folder: Path | None, output: Path | None) -> None:
    """Write stub files of your packages, so that editors and type checkers know the fields of each class.

    Pylance and pyright search a folder named typings in the project without any setting. Run the command again after
    you have changed a definition.

    Example: coframe interfaces stubs . --output typings
    """
    _search_from(folder)
    found: dict[str, Path] = {}
    for source in sources():
        for name, path in _packages_in(source).items():
            found.setdefault(name, path)
    if not found:
        fail(
            "no packages of yours were found",
            "Give the folder of the program that uses them: coframe interfaces stubs FOLDER.",
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


def _show(package: InterfacePackage, own: str) -> None:
    kind, _, name = own.partition("/")
    try:
        text, file = package.definition(kind, name)
        hashed = type_hash(find(f"{package.name}/{own}"))
    except InterfaceError as error:
        fail(str(error), error.hint)
    click.echo(printable(f"# {package.name}/{own}, {file or 'contained in coframe'}"))
    click.echo(f"# {hashed}")
    click.echo("\n".join(map(printable, text.strip().splitlines())))


def _report(errors: list[InterfaceError]) -> None:
    for text in dict.fromkeys(f"{error}" + (f" ({error.hint})" if error.hint else "") for error in errors):
        warn(text)
    if errors:
        raise Exit(1)
