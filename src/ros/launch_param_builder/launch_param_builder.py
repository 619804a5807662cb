# SPDX-License-Identifier: Apache-2.0
"""The builder of parameters."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from ament_index_python.packages import get_package_share_directory
from launch_param_builder.utils import load_file, load_xacro, load_yaml

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["ParameterBuilder"]


class ParameterBuilder:
    """Collects parameters; its methods return the builder itself, so that calls can follow one another.

    Args:
        package_name: The package whose files are read.

    Raises:
        PackageNotFoundError: The package does not exist.
    """

    def __init__(self, package_name: str) -> None:
        self._package_path = Path(get_package_share_directory(package_name))
        self._parameters: dict[str, Any] = {}

    def yaml(self, file_path: str, parameter_namespace: str | None = None) -> ParameterBuilder:
        """Add the values of a YAML file.

        Args:
            file_path: The file, relative to the package.
            parameter_namespace: Parameter under which the values are put; without it, they are parameters themselves.
        """
        values = load_yaml(self._package_path / file_path)
        if parameter_namespace:
            self._parameters.setdefault(parameter_namespace, {}).update(values or {})
        else:
            self._parameters.update(values or {})
        return self

    def file_parameter(self, parameter_name: str, file_path: str) -> ParameterBuilder:
        """Add the contents of a file.

        Args:
            parameter_name: Name of the parameter.
            file_path: The file, relative to the package.
        """
        self._parameters[parameter_name] = load_file(self._package_path / file_path)
        return self

    def xacro_parameter(
        self, parameter_name: str, file_path: str, mappings: Mapping[str, str] | None = None
    ) -> ParameterBuilder:
        """Add the XML of a xacro file.

        Args:
            parameter_name: Name of the parameter.
            file_path: The file, relative to the package.
            mappings: The values of its arguments.
        """
        self._parameters[parameter_name] = load_xacro(self._package_path / file_path, mappings)
        return self

    def parameter(self, parameter_name: str, parameter_value: Any) -> ParameterBuilder:
        """Add a parameter.

        Args:
            parameter_name: Name of the parameter.
            parameter_value: Its value.
        """
        self._parameters[parameter_name] = parameter_value
        return self

    def to_dict(self) -> dict[str, Any]:
        """Return the parameters."""
        return self._parameters
