# SPDX-License-Identifier: Apache-2.0
"""``coframe pkg``: packages and their executables, with the same names and output as ``ros2 pkg``."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import click

import coframe
from coframe._files.bounded_xml import MAX_BYTES, read_xml
from coframe._files.regular_files import read_regular, reading_hint
from coframe.cli.declaration import PATH, Command, CommandGroup, argument
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.output import fail, printable
from coframe.cli.ros2.new_package import BUILD_TYPES, NewPackage, write_package

__all__ = ["pkg"]

package_argument = argument("package_name", metavar="PACKAGE", help="Name of the package.")
pkg = CommandGroup(
    "pkg",
    help="Create and find packages, like ros2 pkg.\n\nExample: coframe pkg create arm --node-name wave",
)


class CreateCommand(Command):
    """The command ``pkg create``: ``--dependencies`` takes all words up to the next option, as in ros2."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Parse the arguments after repeating ``--dependencies`` in front of each of its words."""
        words: list[str] = []
        repeated = ""
        for word in args:
            if word.startswith("-"):
                repeated = word if word == "--dependencies" else ""
                words += [] if repeated else [word]
            else:
                words += [repeated, word] if repeated else [word]
        return super().parse_args(ctx, words)


@pkg.command(cls=CreateCommand, short_help="Create a package.")
@argument("package_name", metavar="NAME", help="Name of the new package.")
@click.option("--node-name", metavar="NAME", help="Also create an executable of this name that runs a node.")
@click.option(
    "--destination-directory",
    "destination",
    metavar="FOLDER",
    type=PATH,
    default=Path(),
    help="Folder in which to create the package.",
)
@click.option("--dependencies", metavar="PACKAGE...", multiple=True, help="Packages on which the new package depends.")
@click.option("--description", metavar="SENTENCE", default="A ROS 2 package", help="Description of the package.")
@click.option(
    "--license", "license_name", metavar="NAME", default="No license declared", help="License of the package."
)
@click.option("--maintainer-name", metavar="NAME", help="Name of the maintainer.")
@click.option("--maintainer-email", metavar="EMAIL", help="E-mail address of the maintainer.")
@click.option("--package-format", "--package_format", default="3", hidden=True)
@click.option("--library-name", metavar="NAME", hidden=True)
@click.option(
    "--build-type",
    metavar="TYPE",
    default="ament_python",
    help="ament_python for a Python package, or ament_cmake for a package of message, service and action types.",
)
def create(
    package_name: str,
    node_name: str | None,
    destination: Path,
    dependencies: tuple[str, ...],
    description: str,
    license_name: str,
    maintainer_name: str | None,
    maintainer_email: str | None,
    package_format: str,
    library_name: str | None,
    build_type: str,
) -> None:
    """Create a package that coframe and colcon can use, for Python nodes or for types.

    A package for types has the folders msg, srv and action, whose files coframe uses without a build.

        Example: coframe pkg create arm --node-name wave --dependencies rclpy
    """
    del package_format
    if build_type not in BUILD_TYPES:
        fail(f"--build-type: {build_type!r} is not supported", f"Types: {', '.join(BUILD_TYPES)}.", code=2)
    if library_name is not None or (build_type == "ament_cmake" and node_name is not None):
        fail(
            "coframe cannot create C++ programs or libraries",
            "Use --build-type ament_python with --node-name for a Python node.",
            code=2,
        )
    package = NewPackage(
        package_name,
        node_name,
        tuple(dependencies or ()),
        description,
        license_name,
        maintainer_name,
        maintainer_email,
        build_type,
    )
    with run_to_completion():
        for path in write_package(package, destination):
            print(f"creating {printable(str(path))}")


@pkg.command(short_help="List the executables of packages.")
@argument("package_name", metavar="[PACKAGE]", required=False, help="Name of a package. [default: all packages]")
@click.option("--full-path", is_flag=True, help="Also show the command of each executable.")
def executables(package_name: str | None, full_path: bool) -> None:
    """List the executables that coframe run can start.

    Example: coframe pkg executables turtlesim
    """
    with run_to_completion():
        from coframe.workspace.packages import executables as search  # noqa: PLC0415 - slow import
        from coframe.workspace.packages import finding  # noqa: PLC0415

        if package_name is not None:
            finding.find_package(package_name)
        for package in [package_name] if package_name else finding.package_names():
            for name, executable in sorted(search.executables(package).items()):
                words = " ".join(executable.command) if full_path else f"{package} {name}"
                print(printable(words))


@pkg.command("list", short_help="List the packages.")
def list_packages() -> None:
    """List the packages that coframe finds: installed, in source folders, and built-in.

    Example: coframe pkg list
    """
    with run_to_completion():
        from coframe.workspace.packages import finding  # noqa: PLC0415 - slow import

        for name in sorted(finding.package_names()):
            print(printable(name))


@pkg.command(short_help="Print the installation prefix or share folder of a package.")
@package_argument
@click.option("--share", is_flag=True, help="Print the share folder instead.")
def prefix(package_name: str, share: bool) -> None:
    """Print the folder in which a package is installed, or the folder that contains its sources.

    Example: coframe pkg prefix my_robot --share
    """
    with run_to_completion():
        from coframe.workspace.packages import finding  # noqa: PLC0415 - slow import

        package = finding.find_package(package_name)
        print(printable(str(package.share if share else package.prefix)))


@pkg.command(short_help="Print the manifest of a package.")
@package_argument
@click.option("--tag", "-t", metavar="TAG", help="Print only the text of this element.")
def xml(package_name: str, tag: str | None) -> None:
    """Print the package.xml of a package.

    Example: coframe pkg xml my_robot --tag version
    """
    with run_to_completion():
        from coframe.workspace.packages import finding  # noqa: PLC0415 - slow import

        package = finding.find_package(package_name)
        manifest = package.share / "package.xml"
        try:
            content = _built_in(package_name) if package.origin == "builtin" else read_regular(manifest, MAX_BYTES)
        except FileNotFoundError:
            fail(f"Package {package_name} has no package.xml.", f"Its folder is {package.share}.")
        except OSError as error:
            fail(f"{manifest} cannot be read: {error.strerror}", reading_hint(error))
        if tag is None:
            print(printable(content.decode("utf-8", "replace")))
            return
        try:
            root = read_xml(io.BytesIO(content))
        except ValueError as error:
            fail(f"{manifest}: {error}")
        values = [element.text or "" for element in root.iter(tag)]
        if not values:
            fail(f"The manifest of {package_name} has no element <{tag}>.")
        print(printable("\n".join(values)))


def _built_in(name: str) -> bytes:
    """Return a manifest for a ROS package that coframe provides, which has no file."""
    return (
        '<?xml version="1.0"?>\n'
        '<package format="3">\n'
        f"  <name>{name}</name>\n"
        f"  <version>{coframe.__version__}</version>\n"
        f"  <description>The package {name} as coframe provides it.</description>\n"
        "  <license>Apache-2.0</license>\n"
        "</package>\n"
    ).encode()
