# SPDX-License-Identifier: Apache-2.0
"""The substitution of the value of a Python expression."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from launch.frontend.arguments import check_arguments
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["PythonExpression"]


@expose_substitution("eval")
class PythonExpression(Substitution):
    """The value of a Python expression, as text. It can use the module ``math`` and all names in it.

    Args:
        expression: The Python expression to evaluate; it may contain substitutions.
        python_modules: Names of the modules that it can use.
    """

    def __init__(
        self, expression: SomeSubstitutionsType, python_modules: Iterable[SomeSubstitutionsType] = ("math",)
    ) -> None:
        self.__expression = normalize_to_list_of_substitutions(expression)
        self.__python_modules = [normalize_to_list_of_substitutions(name) for name in python_modules]

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(eval EXPRESSION [MODULES])``. The modules are separated by commas."""
        check_arguments("eval", data, 1, 2)
        options: dict[str, Any] = {"expression": data[0]}
        if len(data) == 2:
            modules = [part.text for part in normalize_to_list_of_substitutions(data[1]) if hasattr(part, "text")]
            options["python_modules"] = [name.strip() for name in "".join(modules).split(",")]
        return cls, options

    @property
    def expression(self) -> list[Substitution]:
        """The expression."""
        return self.__expression

    @property
    def python_modules(self) -> list[list[Substitution]]:
        """The names of the modules that the expression can use."""
        return self.__python_modules

    def describe(self) -> str:
        """Return a one-line description."""
        return f"PythonExpr({' + '.join(part.describe() for part in self.expression)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value."""
        text = perform_substitutions(context, self.__expression)
        names: dict[str, Any] = {}
        for name in self.__python_modules:
            module = importlib.import_module(perform_substitutions(context, name))
            if module.__name__ == "math":
                names.update(vars(module))
            names[module.__name__] = module
        try:
            return str(eval(text, {}, names))  # noqa: S307 - launch files are programs
        except Exception as error:
            raise SubstitutionFailure(f"PythonExpression {text!r} failed: {type(error).__name__}: {error}") from error
