# SPDX-License-Identifier: Apache-2.0
"""The substitution with the contents of a file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe._files.bounded_yaml import MAX_BYTES
from coframe._files.os_errors import reason
from coframe._files.regular_files import read_regular_text
from launch.frontend.arguments import check_arguments
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["FileContent"]


@expose_substitution("file-content")
class FileContent(Substitution):
    """The contents of a file."""

    def __init__(self, path: SomeSubstitutionsType) -> None:
        self.__path = normalize_to_list_of_substitutions(path)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(file-content PATH)``."""
        check_arguments("file-content", data, 1, 1)
        return cls, {"path": data[0]}

    @property
    def path(self) -> list[Substitution]:
        """The path of the file."""
        return self.__path

    def describe(self) -> str:
        """Return a one-line description."""
        return f"FileContent({' + '.join(part.describe() for part in self.path)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the string."""
        path = perform_substitutions(context, self.__path)
        try:
            return read_regular_text(path, MAX_BYTES)
        except (OSError, UnicodeDecodeError) as error:
            raise SubstitutionFailure(f"Failed to open substitution file: {path}: {reason(error)}") from error
