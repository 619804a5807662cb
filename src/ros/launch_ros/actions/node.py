# SPDX-License-Identifier: Apache-2.0
"""The action that runs a node."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import launch.logging
from launch.actions.execute_local import ExecuteLocal
from launch.actions.execute_process import ExecuteProcess
from launch.descriptions import Executable
from launch.frontend.expose import expose_action
from launch.substitutions import LocalSubstitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.yaml_loading import dump_yaml
from launch_ros.actions.node_parsing import parse_node
from launch_ros.parameter_descriptions import Parameter
from launch_ros.substitutions.executable_in_package import executable_in_package
from launch_ros.temporary_files import write_temporary_file
from launch_ros.utilities import (
    add_node_name,
    evaluate_parameters,
    get_node_name_count,
    make_namespace_absolute,
    normalize_parameters,
    normalize_remap_rules,
    prefix_namespace,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from launch.action import Action
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution
    from launch_ros.parameters_type import SomeParameters
    from launch_ros.remap_rule_type import SomeRemapRules

__all__ = ["Node"]


class _NodeExecutable(Executable):
    """A command whose first word is an executable of a package."""

    def __init__(self, *, package: SomeSubstitutionsType | None, **options: Any) -> None:
        super().__init__(**options)
        self.package = None if package is None else normalize_to_list_of_substitutions(package)

    def _program(self, context: LaunchContext, word: str) -> tuple[Sequence[str], Mapping[str, str]]:
        if self.package is None:
            return [word], {}
        found = executable_in_package(perform_substitutions(context, self.package), word)
        return found.command, {"PYTHONPATH": found.environment(context.environment).get("PYTHONPATH", "")}


@expose_action("node")
class Node(ExecuteLocal):
    """Run a node.

    Args:
        executable: Name of the executable in the package; without a package, its path.
        package: Name of the package.
        name: Name of the node, instead of that in its program.
        namespace: Namespace, relative to PushRosNamespace.
        exec_name: Name of the process in the output.
        parameters: Dictionaries, files and descriptions of parameters; later ones override earlier ones.
        remappings: Pairs of names.
        ros_arguments: Additional arguments after ``--ros-args``.
        arguments: Arguments of the program.
        options: Keyword arguments of ExecuteProcess.
    """

    UNSPECIFIED_NODE_NAME = "<node_name_unspecified>"
    UNSPECIFIED_NODE_NAMESPACE = "<node_namespace_unspecified>"

    def __init__(
        self,
        *,
        executable: SomeSubstitutionsType,
        package: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        namespace: SomeSubstitutionsType | None = None,
        exec_name: SomeSubstitutionsType | None = None,
        parameters: SomeParameters | None = None,
        remappings: SomeRemapRules | None = None,
        ros_arguments: Iterable[SomeSubstitutionsType] | None = None,
        arguments: Iterable[SomeSubstitutionsType] | None = None,
        prefix: SomeSubstitutionsType | None = None,
        cwd: SomeSubstitutionsType | None = None,
        env: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
        additional_env: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
        **options: Any,
    ) -> None:
        cmd: list[SomeSubstitutionsType] = [executable, *(arguments or ()), "--ros-args", *(ros_arguments or ())]
        if name is not None:
            cmd += ["-r", LocalSubstitution("ros_specific_arguments['name']", description="node name")]
        self.__package = None if package is None else normalize_to_list_of_substitutions(package)
        self.__executable = normalize_to_list_of_substitutions(executable)
        self.__node_name = None if name is None else normalize_to_list_of_substitutions(name)
        self.__node_namespace = None if namespace is None else normalize_to_list_of_substitutions(namespace)
        self.__parameters: tuple[Any, ...] = () if parameters is None else normalize_parameters(parameters)
        self.__remappings = [] if remappings is None else list(normalize_remap_rules(remappings))
        self.__arguments = arguments
        self.__expanded_node_name = self.UNSPECIFIED_NODE_NAME
        self.__expanded_node_namespace = self.UNSPECIFIED_NODE_NAMESPACE
        self.__expanded_parameter_arguments: list[tuple[str, bool]] = []
        self.__expanded_remappings: list[tuple[str, str]] = []
        self.__are_substitutions_performed = False
        description = _NodeExecutable(
            package=package, cmd=cmd, name=exec_name, prefix=prefix, cwd=cwd, env=env, additional_env=additional_env
        )
        super().__init__(process_description=description, **options)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<node pkg=... exec=...>``."""
        _, options = ExecuteProcess.parse(entity, parser, ignore=["cmd", "name"])
        return cls, options | parse_node(entity, parser)

    @property
    def node_package(self) -> list[Substitution] | None:
        """The name of the package."""
        return self.__package

    @property
    def node_executable(self) -> list[Substitution]:
        """The name of the executable."""
        return self.__executable

    @property
    def arguments(self) -> Any:
        """The arguments of the program."""
        return self.__arguments

    @property
    def node_name(self) -> str:
        """The full name, or the known part of it."""
        if not self.__are_substitutions_performed:
            raise RuntimeError("cannot access 'node_name' before executing action")
        namespace = self.__expanded_node_namespace
        if namespace in {"", self.UNSPECIFIED_NODE_NAMESPACE}:
            namespace = "/" if namespace == "" else f"{namespace}/"
        elif not namespace.endswith("/"):
            namespace += "/"
        return namespace + self.__expanded_node_name

    @property
    def expanded_node_namespace(self) -> str:
        """The namespace."""
        return self.__expanded_node_namespace

    @property
    def expanded_remapping_rules(self) -> list[tuple[str, str]]:
        """The remappings."""
        return self.__expanded_remappings

    def is_node_name_fully_specified(self) -> bool:
        """Return whether name and namespace of the node are known."""
        return "<node_name" not in self.node_name and "<node_namespace" not in self.node_name

    def _perform_substitutions(self, context: LaunchContext) -> None:
        """Compute names, parameters and remappings, and append them to the command."""
        if self.__are_substitutions_performed:
            return
        self.__are_substitutions_performed = True
        if self.__node_name is not None:
            self.__expanded_node_name = perform_substitutions(context, self.__node_name)
        own = None if self.__node_namespace is None else perform_substitutions(context, self.__node_namespace)
        base = context.launch_configurations.get("ros_namespace")
        combined = make_namespace_absolute(prefix_namespace(base, own))
        if combined is not None:
            self.__expanded_node_namespace = combined
            self.__extend_command(["-r", LocalSubstitution("ros_specific_arguments['ns']", description="namespace")])
        self.__expand_parameters(context)
        self.__expanded_remappings = list(context.launch_configurations.get("ros_remaps", []))
        for source, target in self.__remappings:
            self.__expanded_remappings.append(
                (perform_substitutions(context, source), perform_substitutions(context, target))
            )
        for before, after in self.__expanded_remappings:
            self.__extend_command(["-r", f"{before}:={after}"])

    def __expand_parameters(self, context: LaunchContext) -> None:
        for each in context.launch_configurations.get("global_params", []):
            if isinstance(each, tuple):
                self.__extend_command(["-p", f"{each[0]}:={each[1]}"])
            else:
                self.__add_parameter(str(Path(each).absolute()), is_file=True)
        for parameters in evaluate_parameters(context, self.__parameters):
            if isinstance(parameters, dict):
                self.__add_parameter(self._create_params_file_from_dict(parameters), is_file=True)
            elif isinstance(parameters, Parameter):
                self.__add_parameter(_parameter_rule(parameters, context), is_file=False)
            else:
                self.__add_parameter(str(parameters), is_file=True)

    def __extend_command(self, words: list[SomeSubstitutionsType]) -> None:
        self.process_description.cmd.extend(normalize_to_list_of_substitutions(word) for word in words)

    def __add_parameter(self, argument: str, *, is_file: bool) -> None:
        if is_file and not Path(argument).is_file():
            launch.logging.get_logger("launch_ros.actions.node").warning(
                f"Parameter file path is not a file: {argument}"
            )
            return
        self.__expanded_parameter_arguments.append((argument, is_file))
        self.__extend_command(["--params-file" if is_file else "-p", argument])

    def _create_params_file_from_dict(self, params: dict[str, Any]) -> str:
        node = self.node_name if self.is_node_name_fully_specified() else "/**"
        return str(write_temporary_file(dump_yaml({node: {"ros__parameters": params}})))

    def prepare(self, context: LaunchContext) -> None:
        """Compute the command."""
        self._perform_substitutions(context)
        specific = {}
        if self.__node_name is not None:
            specific["name"] = f"__node:={self.__expanded_node_name}"
        if self.__expanded_node_namespace != self.UNSPECIFIED_NODE_NAMESPACE:
            specific["ns"] = f"__ns:={self.__expanded_node_namespace}"
        context.extend_locals({"ros_specific_arguments": specific})
        super().prepare(context)

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Start the node, and warn if there is another node of the same name."""
        result = super().execute(context)
        if self.is_node_name_fully_specified():
            add_node_name(context, self.node_name)
            count = get_node_name_count(context, self.node_name)
            if count > 1:
                launch.logging.get_logger("launch_ros.actions.node").warning(
                    f"there are now at least {count} nodes with the name {self.node_name} created within this launch "
                    "context"
                )
        return result


def _parameter_rule(parameter: Parameter, context: LaunchContext) -> str:
    name, value = parameter.evaluate(context)
    return f"{name}:={dump_yaml(value).removesuffix('...' + chr(10)).strip()}"
