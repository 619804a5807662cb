# SPDX-License-Identifier: Apache-2.0
"""The description of a process: command, name, working directory and environment."""

from __future__ import annotations

import itertools
import os
import re
import shlex
from pathlib import PurePath
from typing import TYPE_CHECKING

from coframe._process.python_children import child_environment
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from launch.action import Action
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["Executable"]

_numbers: Iterator[int] = itertools.count(1)


class Executable:
    """A command with its name, working directory and environment, which can contain substitutions.

    Args:
        cmd: The words of the command.
        prefix: Words to put in front, such as ``gdb --args``, or None for the launch configuration ``launch-prefix``.
        name: Name of the process, or None for the file name of the executable. A number is appended.
        cwd: Working directory.
        env: Environment, or None for the one of this process.
        additional_env: Variables to add to the environment.
        arguments: Additional arguments of the command.
    """

    def __init__(
        self,
        *,
        cmd: Iterable[SomeSubstitutionsType],
        prefix: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        cwd: SomeSubstitutionsType | None = None,
        env: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
        additional_env: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
        arguments: Iterable[SomeSubstitutionsType] | None = None,
    ) -> None:
        self.__cmd = [normalize_to_list_of_substitutions(word) for word in cmd]
        self.__cmd += [normalize_to_list_of_substitutions(word) for word in arguments or ()]
        self.__prefix = _normalize(prefix)
        self.__name = _normalize(name)
        self.__cwd = _normalize(cwd)
        self.__env = _normalized_pairs(env)
        self.__additional_env = _normalized_pairs(additional_env)
        self.__final_cmd: list[str] | None = None
        self.__final_name: str | None = None
        self.__final_cwd: str | None = None
        self.__final_env: dict[str, str] | None = None

    @property
    def name(self) -> list[Substitution] | None:
        """The name, without its number."""
        return self.__name

    @property
    def prefix(self) -> list[Substitution] | None:
        """The words in front of the command."""
        return self.__prefix

    @property
    def cmd(self) -> list[list[Substitution]]:
        """The words of the command, each as a list of substitutions."""
        return self.__cmd

    @property
    def cwd(self) -> list[Substitution] | None:
        """The working directory."""
        return self.__cwd

    @property
    def env(self) -> list[tuple[list[Substitution], list[Substitution]]] | None:
        """The environment."""
        return self.__env

    @property
    def additional_env(self) -> list[tuple[list[Substitution], list[Substitution]]] | None:
        """The variables that are added to the environment."""
        return self.__additional_env

    @property
    def final_name(self) -> str | None:
        """The name with its number, or None before the command was prepared."""
        return self.__final_name

    @property
    def final_cmd(self) -> list[str] | None:
        """The words of the command, or None before the command was prepared."""
        return self.__final_cmd

    @property
    def final_cwd(self) -> str | None:
        """The working directory, or None for the current one."""
        return self.__final_cwd

    @property
    def final_env(self) -> dict[str, str] | None:
        """The environment, or None before the command was prepared."""
        return self.__final_env

    def prepare(self, context: LaunchContext, action: Action) -> None:
        """Prepare the description before its substitutions are performed. Subclasses override it."""

    def apply_context(self, context: LaunchContext) -> None:
        """Perform all substitutions."""
        first, *words = [perform_substitutions(context, word) for word in self.__cmd]
        program, program_env = self._program(context, first)
        name = _program_name(first) if self.__name is None else perform_substitutions(context, self.__name)
        self.__final_name = f"{name}-{next(_numbers)}"
        self.__final_cmd = [*self._prefix_words(context, name), *program, *words]
        self.__final_cwd = None if self.__cwd is None else perform_substitutions(context, self.__cwd)
        base = child_environment(context.environment) if self.__env is None else _perform(context, self.__env)
        self.__final_env = {**base, **program_env, **_perform(context, self.__additional_env or [])}

    def _program(self, context: LaunchContext, word: str) -> tuple[Sequence[str], Mapping[str, str]]:
        """Return the command line of the program and its environment variables. Subclasses override it."""
        del context
        return [word], {}

    def _prefix_words(self, context: LaunchContext, name: str) -> list[str]:
        if self.__prefix is not None:
            return shlex.split(perform_substitutions(context, self.__prefix))
        prefix = context.launch_configurations.get("launch-prefix", "")
        pattern = context.launch_configurations.get("launch-prefix-filter", "")
        return shlex.split(prefix) if not pattern or re.match(pattern, name) else []


def _program_name(word: str) -> str:
    parts = shlex.split(word, posix=os.name == "posix") or [word]  # With a shell, the command is one word.
    return PurePath(parts[0]).name


def _normalize(subs: SomeSubstitutionsType | None) -> list[Substitution] | None:
    return None if subs is None else normalize_to_list_of_substitutions(subs)


def _normalized_pairs(
    pairs: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None,
) -> list[tuple[list[Substitution], list[Substitution]]] | None:
    if pairs is None:
        return None
    items = [(normalize_to_list_of_substitutions(name), value) for name, value in pairs.items()]
    return [(name, normalize_to_list_of_substitutions(value)) for name, value in items]


def _perform(context: LaunchContext, pairs: list[tuple[list[Substitution], list[Substitution]]]) -> dict[str, str]:
    return {perform_substitutions(context, name): perform_substitutions(context, value) for name, value in pairs}
