# SPDX-License-Identifier: Apache-2.0
"""The substitutions of the folders of packages."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe._output.formatting import error_text
from coframe.errors import PackageError
from coframe.workspace.packages.finding import Package, find_package
from launch.frontend.arguments import check_arguments
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["FindPackage", "FindPackagePrefix", "FindPackageShare", "PackageNotFoundError"]


class PackageNotFoundError(SubstitutionFailure):
    """The package does not exist."""


class FindPackage(Substitution):
    """Base class: a folder of a package."""

    def __init__(self, package: SomeSubstitutionsType) -> None:
        self.__package = normalize_to_list_of_substitutions(package)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(find-pkg-share PACKAGE)``."""
        check_arguments(cls.__name__, data, 1, 1)
        return cls, {"package": data[0]}

    @property
    def package(self) -> list[Substitution]:
        """The name of the package."""
        return self.__package

    def describe(self) -> str:
        """Return a one-line description."""
        return f"{type(self).__name__}(pkg={' + '.join(part.describe() for part in self.package)})"

    def find(self, package_name: str) -> str:
        """Return the folder. Subclasses override it."""
        raise NotImplementedError

    def perform(self, context: LaunchContext) -> str:
        """Return the folder."""
        return self.find(perform_substitutions(context, self.__package))


@expose_substitution("find-pkg-prefix")
class FindPackagePrefix(FindPackage):
    """The installation prefix of a package."""

    def find(self, package_name: str) -> str:
        """Return the prefix. For a package that is not installed, the folder that contains it."""
        return str(_found(package_name).prefix)


@expose_substitution("find-pkg-share")
class FindPackageShare(FindPackage):
    """The folder with the launch files and other data of a package."""

    def find(self, package_name: str) -> str:
        """Return the folder. For a package that is not installed, its source folder."""
        return str(_found(package_name).share)


def _found(name: str) -> Package:
    try:
        return find_package(name)
    except PackageError as error:
        raise PackageNotFoundError(error_text(error)) from None
