# SPDX-License-Identifier: Apache-2.0
"""``coframe pkg``: packages and their executables, with the words and the output of ``ros2 pkg``."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Annotated, Any

import typer

from coframe.bounded_xml import MAX_BYTES, read_xml
from coframe.cli.help_format import PlainCommand, PlainGroup
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.output import fail, printable
from coframe.cli.ros2.new_package import NewPackage, write_package
from coframe.regular_files import read_regular, reading_hint

__all__ = ["pkg"]

PackageArgument = Annotated[str, typer.Argument(metavar="PACKAGE", help="Name of the package.")]
pkg = typer.Typer(
    cls=PlainGroup,
    help="Create and find packages, like ros2 pkg.\n\nExample: coframe pkg create arm --node-name wave",
    no_args_is_help=True,
    rich_markup_mode=None,
)


class CreateCommand(PlainCommand):
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


@pkg.command(cls=CreateCommand, short_help="Create a Python package.")
def create(
    package_name: Annotated[str, typer.Argument(metavar="NAME", help="Name of the new package.")],
    node_name: Annotated[
        str | None, typer.Option("--node-name", metavar="NAME", help="Name of an executable with a first node.")
    ] = None,
    destination: Annotated[
        Path, typer.Option("--destination-directory", metavar="FOLDER", help="Folder in which to create it.")
    ] = Path(),
    dependencies: Annotated[
        list[str] | None,
        typer.Option("--dependencies", metavar="PACKAGE...", help="Packages that it depends on."),
    ] = None,
    description: Annotated[
        str, typer.Option("--description", metavar="SENTENCE", help="What the package is for.")
    ] = "A ROS 2 package",
    license_name: Annotated[
        str, typer.Option("--license", metavar="NAME", help="Licence of the package.")
    ] = "No license declared",
    maintainer_name: Annotated[
        str | None, typer.Option("--maintainer-name", metavar="NAME", help="Name of the maintainer.")
    ] = None,
    maintainer_email: Annotated[
        str | None, typer.Option("--maintainer-email", metavar="EMAIL", help="E-mail address of the maintainer.")
    ] = None,
    build_type: Annotated[
        str, typer.Option("--build-type", metavar="TYPE", help="Only ament_python is supported.")
    ] = "ament_python",
) -> None:
    """Create a Python package that coframe, pip and colcon can use.

    Example: coframe pkg create arm --node-name wave --dependencies rclpy
    """
    if build_type != "ament_python":
        fail(
            f"--build-type: {build_type!r} is not supported",
            "coframe runs Python nodes: use ament_python.",
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
    )
    with run_to_completion():
        for path in write_package(package, destination):
            print(f"creating {printable(str(path))}")


@pkg.command(cls=PlainCommand, short_help="List the executables of packages.")
def executables(
    package_name: Annotated[
        str | None, typer.Argument(metavar="[PACKAGE]", help="Name of a package. [default: all packages]")
    ] = None,
    full_path: Annotated[bool, typer.Option("--full-path", help="Show the words that start each one.")] = False,
) -> None:
    """List the executables that coframe run can start.

    Example: coframe pkg executables turtlesim
    """
    with run_to_completion():
        from coframe.packages import executables as search  # noqa: PLC0415 - slow import
        from coframe.packages import finding  # noqa: PLC0415

        if package_name is not None:
            finding.find_package(package_name)
        for package in [package_name] if package_name else finding.package_names():
            for name, executable in sorted(search.executables(package).items()):
                words = " ".join(executable.command) if full_path else f"{package} {name}"
                print(printable(words))


@pkg.command("list", cls=PlainCommand, short_help="List the packages.")
def list_packages() -> None:
    """List the packages that coframe finds: installed ones, source folders and its own.

    Example: coframe pkg list
    """
    with run_to_completion():
        from coframe.packages import finding  # noqa: PLC0415 - slow import

        for name in sorted(finding.package_names()):
            print(printable(name))


@pkg.command(cls=PlainCommand, short_help="Print the prefix or the share folder of a package.")
def prefix(
    package_name: PackageArgument,
    share: Annotated[bool, typer.Option("--share", help="Print the folder of its data instead.")] = False,
) -> None:
    """Print the folder in which a package is installed, or the folder that contains its sources.

    Example: coframe pkg prefix my_robot --share
    """
    with run_to_completion():
        from coframe.packages import finding  # noqa: PLC0415 - slow import

        package = finding.find_package(package_name)
        print(printable(str(package.share if share else package.prefix)))


@pkg.command(cls=PlainCommand, short_help="Print the manifest of a package.")
def xml(
    package_name: PackageArgument,
    tag: Annotated[
        str | None, typer.Option("--tag", "-t", metavar="TAG", help="Print only the text of this element.")
    ] = None,
) -> None:
    """Print the package.xml of a package.

    Example: coframe pkg xml my_robot --tag version
    """
    with run_to_completion():
        from coframe.packages import finding  # noqa: PLC0415 - slow import

        manifest = finding.find_package(package_name).share / "package.xml"
        try:
            content = read_regular(manifest, MAX_BYTES)
        except FileNotFoundError:
            fail(f"Package {package_name} has no package.xml.", "It is a package of coframe itself.")
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
