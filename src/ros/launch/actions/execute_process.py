# SPDX-License-Identifier: Apache-2.0
"""The action that runs a command."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING, Any

from launch.actions.execute_local import ExecuteLocal
from launch.actions.shutdown_action import Shutdown
from launch.descriptions import Executable
from launch.frontend.expose import expose_action
from launch.substitutions import TextSubstitution

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from launch.action import Action
    from launch.frontend import Entity, Parser
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["ExecuteProcess"]


@expose_action("executable")
class ExecuteProcess(ExecuteLocal):
    """Run a command until it ends or the system shuts down.

    Args:
        cmd: The words of the command; each may consist of several substitutions.
        prefix: Words to put in front, such as ``gdb --args``.
        name: Name of the process; the file name of the executable by default.
        cwd: Working directory.
        env: Environment; by default the environment of this process.
        additional_env: Variables to add to the environment.
        options: Keyword arguments of ExecuteLocal.
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
        **options: Any,
    ) -> None:
        description = Executable(cmd=cmd, prefix=prefix, name=name, cwd=cwd, env=env, additional_env=additional_env)
        super().__init__(process_description=description, **options)

    @classmethod
    def _parse_cmdline(cls, cmd: str, parser: Parser) -> list[list[Substitution]]:
        """Split a command line at spaces outside of quotes and substitutions."""
        words: list[list[Substitution]] = [[]]
        for part in parser.parse_substitution(cmd):
            if not isinstance(part, TextSubstitution):
                words[-1].append(part)
                continue
            text = part.text
            if text[:1].isspace() and words[-1]:
                words.append([])
            pieces = shlex.split(text)
            for index, piece in enumerate(pieces):
                if index > 0:
                    words.append([])
                words[-1].append(TextSubstitution(text=piece))
            if text[-1:].isspace() and words[-1]:
                words.append([])
        return words if words[-1] else words[:-1]

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser, ignore: list[str] | None = None
    ) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<executable cmd=...>``.

        Args:
            entity: The element.
            parser: The parser of the file.
            ignore: Attributes that a subclass reads.
        """
        _, options = super().parse(entity, parser)
        ignored = set(ignore or ())
        if "cmd" not in ignored:
            options["cmd"] = cls._parse_cmdline(entity.get_attr("cmd"), parser)
        for name, keyword in (("cwd", "cwd"), ("name", "name"), ("launch-prefix", "prefix"), ("output", "output")):
            text = entity.get_attr(name, optional=True) if name not in ignored else None
            if text is not None:
                options[keyword] = parser.parse_substitution(text)
        options |= _parse_typed_attributes(entity, parser)
        if "on_exit" not in ignored:
            options |= _parse_on_exit(entity)
        if "env" not in ignored:
            options |= _parse_environment(entity, parser)
        return cls, options


def _parse_typed_attributes(entity: Entity, parser: Parser) -> dict[str, Any]:
    types = dict.fromkeys(("sigterm_timeout", "sigkill_timeout", "respawn_delay"), float)
    types |= dict.fromkeys(("respawn", "emulate_tty", "shell"), bool)
    values = {
        name: entity.get_attr(name, data_type=data_type, optional=True, can_be_str=name != "shell")
        for name, data_type in {**types, "respawn_max_retries": int}.items()
    }
    return {name: parser.parse_if_substitutions(value) for name, value in values.items() if value is not None}


def _parse_on_exit(entity: Entity) -> dict[str, Any]:
    on_exit = entity.get_attr("on_exit", optional=True)
    if on_exit is None:
        return {}
    if on_exit != "shutdown":
        raise ValueError("Attribute on_exit of Entity node expected to be `shutdown` but got `" + on_exit + "`")
    return {"on_exit": [Shutdown()]}


def _parse_environment(entity: Entity, parser: Parser) -> dict[str, Any]:
    variables = entity.get_attr("env", data_type=list, optional=True)
    if variables is None:
        return {}
    found = {}
    for variable in variables:
        name = tuple(parser.parse_substitution(variable.get_attr("name")))
        found[name] = parser.parse_substitution(variable.get_attr("value"))
        variable.assert_entity_completely_parsed()
    return {"additional_env": found}
