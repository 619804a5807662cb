# SPDX-License-Identifier: Apache-2.0
"""Descriptions of parameters: a value with a type, a parameter with a name, and a file of parameters."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe._files.bounded_yaml import MAX_BYTES
from coframe._files.regular_files import read_regular_text
from launch.frontend.substitution_grammar import parse_text
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution
from launch_ros.temporary_files import write_temporary_file

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["Parameter", "ParameterFile", "ParameterValue"]


class ParameterValue:
    """The value of a parameter with its type, for values that consist of substitutions.

    Args:
        value: The value of the parameter; it may contain substitutions.
        value_type: Its type, such as `str`, or None for the type that YAML gives the text.
    """

    def __init__(self, value: Any, *, value_type: Any = None) -> None:
        self.__value = normalize_typed_substitution(value, value_type)
        self.__value_type = value_type
        self.__evaluated: Any = None

    @property
    def value(self) -> Any:
        """The value, evaluated once a node has used it."""
        return self.__value if self.__evaluated is None else self.__evaluated

    @property
    def value_type(self) -> Any:
        """The type."""
        return self.__value_type

    def __str__(self) -> str:
        return f"launch_ros.description.ParameterValue(value={self.value}, value_type={self.value_type})"

    def evaluate(self, context: LaunchContext) -> Any:
        """Return the value, with its substitutions performed."""
        self.__evaluated = perform_typed_substitution(context, self.__value, self.__value_type)
        return self.__evaluated


class Parameter:
    """A parameter that is passed as ``-p NAME:=VALUE``.

    Args:
        name: The name of the parameter.
        value: The value of the parameter.
        value_type: The type of the value, or None for the type that YAML gives it.
    """

    def __init__(self, name: SomeSubstitutionsType, value: Any, *, value_type: Any = None) -> None:
        self.__name = normalize_to_list_of_substitutions(name)
        self.__value = ParameterValue(value, value_type=value_type)

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self.__name

    @property
    def value(self) -> Any:
        """The value."""
        return self.__value.value

    @property
    def value_type(self) -> Any:
        """The type of the value."""
        return self.__value.value_type

    def __str__(self) -> str:
        return f"launch_ros.description.Parameter(name={self.name}, value={self.value}, value_type={self.value_type})"

    def evaluate(self, context: LaunchContext) -> tuple[str, Any]:
        """Return name and value, with their substitutions performed."""
        return perform_substitutions(context, self.__name), self.__value.evaluate(context)


class ParameterFile:
    """A file of parameters.

    Args:
        param_file: Its path.
        allow_substs: Perform the substitutions in the text of the file.
    """

    def __init__(self, param_file: Any, *, allow_substs: bool | SomeSubstitutionsType = False) -> None:
        self.__param_file = normalize_to_list_of_substitutions(param_file)
        self.__allow_substs = normalize_typed_substitution(allow_substs, bool)
        self.__evaluated: Path | None = None

    @property
    def param_file(self) -> Any:
        """The path, evaluated once a node has used it."""
        return self.__evaluated or self.__param_file

    @property
    def allow_substs(self) -> Any:
        """Whether the substitutions in the text are performed."""
        return self.__allow_substs

    def __str__(self) -> str:
        return f"launch_ros.description.ParameterFile(param_file={self.param_file}, allow_substs={self.allow_substs})"

    def evaluate(self, context: LaunchContext) -> Path:
        """Return the path. If the file has substitutions, the path of a copy in which they are performed."""
        path = Path(perform_substitutions(context, self.__param_file))
        if perform_typed_substitution(context, self.__allow_substs, bool) and path.is_file():
            text = perform_substitutions(context, parse_text(read_regular_text(path, MAX_BYTES)))
            path = write_temporary_file(text)
        self.__evaluated = path
        return path

    def cleanup(self) -> None:
        """Do nothing: temporary files are removed when the program ends."""
