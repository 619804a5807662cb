# SPDX-License-Identifier: Apache-2.0
"""The parameters of MoveIt from the configuration package of a robot.

The package is that of MoveIt's setup assistant: it contains the file ``.setup_assistant`` and the folder ``config``.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from ament_index_python.packages import get_package_share_directory
from launch_param_builder import ParameterBuilder, ParameterBuilderFileNotFoundError, load_xacro, load_yaml
from launch_ros.parameter_descriptions import ParameterValue
from moveit_configs_utils.substitutions import Xacro

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

__all__ = ["MoveItConfigs", "MoveItConfigsBuilder", "get_pattern_matches"]

_DEFAULTS: Final = Path(__file__).with_name("default_configs")
_CONFIG_FOLDER: Final = Path("config")
_PILZ_FILE: Final = "pilz_industrial_motion_planner"


@dataclass
class MoveItConfigs:
    """The parameters of MoveIt, by their purpose.

    Attributes:
        package_path: Folder of the configuration package.
        robot_description: The URDF.
        robot_description_semantic: The SRDF.
        robot_description_kinematics: The kinematics solvers of the groups.
        planning_pipelines: The planners.
        trajectory_execution: The controllers.
        planning_scene_monitor: What the planning scene publishes.
        sensors_3d: The sensors of the occupancy map.
        move_group_capabilities: The capabilities of move_group.
        joint_limits: The limits of the joints.
        moveit_cpp: The parameters of MoveItCpp.
        pilz_cartesian_limits: The Cartesian limits of the Pilz planner.
    """

    package_path: str | None = None
    robot_description: dict[str, Any] = field(default_factory=dict)
    robot_description_semantic: dict[str, Any] = field(default_factory=dict)
    robot_description_kinematics: dict[str, Any] = field(default_factory=dict)
    planning_pipelines: dict[str, Any] = field(default_factory=dict)
    trajectory_execution: dict[str, Any] = field(default_factory=dict)
    planning_scene_monitor: dict[str, Any] = field(default_factory=dict)
    sensors_3d: dict[str, Any] = field(default_factory=dict)
    move_group_capabilities: dict[str, Any] = field(
        default_factory=lambda: {"capabilities": "", "disable_capabilities": ""}
    )
    joint_limits: dict[str, Any] = field(default_factory=dict)
    moveit_cpp: dict[str, Any] = field(default_factory=dict)
    pilz_cartesian_limits: dict[str, Any] = field(default_factory=dict)

    def to_dict(self) -> dict[str, Any]:
        """Return all parameters."""
        parameters: dict[str, Any] = {}
        for values in (
            self.robot_description,
            self.robot_description_semantic,
            self.robot_description_kinematics,
            self.planning_pipelines,
            self.trajectory_execution,
            self.planning_scene_monitor,
            self.sensors_3d,
            self.joint_limits,
            self.moveit_cpp,
        ):
            parameters.update(values)
        for name, limits in self.pilz_cartesian_limits.items():
            parameters[name] = {**parameters.get(name, {}), **limits}
        return parameters


class MoveItConfigsBuilder(ParameterBuilder):
    """Reads the files of a configuration package; its methods return the builder itself.

    Files that are not named are found by the conventions of MoveIt's setup assistant.

    Args:
        robot_name: Name of the robot.
        robot_description: Name of the parameter of the URDF.
        package_name: The configuration package; ``ROBOT_moveit_config`` by default.

    Raises:
        PackageNotFoundError: The package does not exist.
    """

    def __init__(
        self, robot_name: str, robot_description: str = "robot_description", package_name: str | None = None
    ) -> None:
        super().__init__(package_name or f"{robot_name}_moveit_config")
        self.__moveit_configs = MoveItConfigs(package_path=str(self._package_path))
        self.__robot_name = robot_name
        self.__robot_description = robot_description
        self.__urdf: Path | None = None
        self.__urdf_mappings: dict[str, str] = {}
        self.__srdf: Path | None = None
        expanded = self._package_path / _CONFIG_FOLDER / f"{robot_name}.urdf.xacro"
        if expanded.exists():
            self.__urdf = expanded
        self.__read_setup_assistant(self._package_path / ".setup_assistant")
        if self.__urdf is None:
            self.__urdf = self.__guess("URDF", "urdf")
        if self.__srdf is None:
            self.__srdf = self.__guess("SRDF", "srdf")

    def __read_setup_assistant(self, file: Path) -> None:
        if not file.exists():
            return
        config = (load_yaml(file) or {}).get("moveit_setup_assistant_config", {})
        urdf = config.get("urdf", config.get("URDF"))
        if urdf and self.__urdf is None:
            self.__urdf = Path(get_package_share_directory(urdf["package"])) / urdf["relative_path"]
            words = (urdf.get("xacro_args") or "").split()
            self.__urdf_mappings = dict(word.split(":=", 1) for word in words)
        if srdf := config.get("srdf", config.get("SRDF")):
            self.__srdf = self._package_path / srdf["relative_path"]

    def __guess(self, kind: str, suffix: str) -> Path:
        path = _CONFIG_FOLDER / f"{self.__robot_name}.{suffix}"
        _warn(f"Cannot infer {kind} from `{self._package_path}`. -- using {path.as_posix()}")
        return self._package_path / path

    def __path(self, file_path: str | None, default: str) -> Path:
        return self._package_path / (_CONFIG_FOLDER / default if file_path is None else file_path)

    def robot_description(
        self, file_path: str | None = None, mappings: Mapping[Any, Any] | None = None
    ) -> MoveItConfigsBuilder:
        """Read the URDF.

        Args:
            file_path: The file, relative to the package; that of the setup assistant by default.
            mappings: The arguments of xacro; they may be substitutions of a launch file.
        """
        path = self.__urdf if file_path is None else self._package_path / file_path
        assert path is not None
        chosen = dict(self.__urdf_mappings if mappings is None else mappings)
        try:
            self.__moveit_configs.robot_description = {self.__robot_description: _description(path, chosen)}
        except ParameterBuilderFileNotFoundError as error:
            _warn(f"{error}")
            _warn("The robot description will be loaded from /robot_description topic ")
        return self

    def robot_description_semantic(
        self, file_path: str | None = None, mappings: Mapping[Any, Any] | None = None
    ) -> MoveItConfigsBuilder:
        """Read the SRDF.

        Args:
            file_path: The file, relative to the package; that of the setup assistant by default.
            mappings: The arguments of xacro; they may be substitutions of a launch file.
        """
        path = self.__srdf if file_path is None else self._package_path / file_path
        assert path is not None
        name = f"{self.__robot_description}_semantic"
        self.__moveit_configs.robot_description_semantic = {name: _description(path, dict(mappings or {}))}
        return self

    def robot_description_kinematics(self, file_path: str | None = None) -> MoveItConfigsBuilder:
        """Read the kinematics solvers of the groups.

        Args:
            file_path: The file, relative to the package; ``config/kinematics.yaml`` by default.
        """
        name = f"{self.__robot_description}_kinematics"
        self.__moveit_configs.robot_description_kinematics = {
            name: load_yaml(self.__path(file_path, "kinematics.yaml"))
        }
        return self

    def joint_limits(self, file_path: str | None = None) -> MoveItConfigsBuilder:
        """Read the limits of the joints.

        Args:
            file_path: The file, relative to the package; ``config/joint_limits.yaml`` by default.
        """
        name = f"{self.__robot_description}_planning"
        self.__moveit_configs.joint_limits = {name: load_yaml(self.__path(file_path, "joint_limits.yaml"))}
        return self

    def moveit_cpp(self, file_path: str | None = None) -> MoveItConfigsBuilder:
        """Read the parameters of MoveItCpp.

        Args:
            file_path: The file, relative to the package; ``config/moveit_cpp.yaml`` by default.
        """
        self.__moveit_configs.moveit_cpp = load_yaml(self.__path(file_path, "moveit_cpp.yaml"))
        return self

    def trajectory_execution(
        self, file_path: str | None = None, moveit_manage_controllers: bool = True
    ) -> MoveItConfigsBuilder:
        """Read the controllers.

        Args:
            file_path: The file, relative to the package; the file ``config/*_controllers.yaml`` by default.
            moveit_manage_controllers: Whether MoveIt starts and stops controllers.

        Raises:
            RuntimeError: There are several such files, and none has a usual name.
        """
        values: dict[str, Any] = {"moveit_manage_controllers": moveit_manage_controllers}
        path = self.__controllers_file() if file_path is None else self._package_path / file_path
        if path is not None:
            values.update(load_yaml(path) or {})
        self.__moveit_configs.trajectory_execution = values
        return self

    def __controllers_file(self) -> Path | None:
        folder = self._package_path / _CONFIG_FOLDER
        names = get_pattern_matches(folder, "_controllers.yaml")
        if not names:
            _warn(
                "trajectory_execution: Parameter file_path is undefined and no matches for "
                f"{folder}/*_controllers.yaml were found"
            )
            return None
        usual = (
            names if len(names) == 1 else [each for each in ("moveit", "moveit2", self.__robot_name) if each in names]
        )
        if not usual:
            listed = "\n - ".join(f"{name}_controllers.yaml" for name in names)
            raise RuntimeError(
                f"trajectory_execution: Unable to guess which parameter file to load. Options:\n - {listed}"
            )
        return folder / f"{usual[0]}_controllers.yaml"

    def planning_scene_monitor(
        self,
        publish_planning_scene: bool = True,
        publish_geometry_updates: bool = True,
        publish_state_updates: bool = True,
        publish_transforms_updates: bool = True,
        publish_robot_description: bool = False,
        publish_robot_description_semantic: bool = False,
    ) -> MoveItConfigsBuilder:
        """Set what the planning scene publishes; each argument is the parameter of this name."""
        self.__moveit_configs.planning_scene_monitor = {
            "publish_planning_scene": publish_planning_scene,
            "publish_geometry_updates": publish_geometry_updates,
            "publish_state_updates": publish_state_updates,
            "publish_transforms_updates": publish_transforms_updates,
            "publish_robot_description": publish_robot_description,
            "publish_robot_description_semantic": publish_robot_description_semantic,
        }
        return self

    def sensors_3d(self, file_path: str | None = None) -> MoveItConfigsBuilder:
        """Read the sensors of the occupancy map, if the file exists.

        Args:
            file_path: The file, relative to the package; ``config/sensors_3d.yaml`` by default.
        """
        path = self.__path(file_path, "sensors_3d.yaml")
        if path.exists():
            values = load_yaml(path) or {}
            sensors = values.get("sensors") or []
            if sensors and sensors[0]:
                self.__moveit_configs.sensors_3d = values
        return self

    def planning_pipelines(
        self,
        default_planning_pipeline: str | None = None,
        pipelines: Sequence[str] | None = None,
        load_all: bool = True,
    ) -> MoveItConfigsBuilder:
        """Read the planners.

        Args:
            default_planning_pipeline: The planner that is used by default; ``ompl``, or the first one.
            pipelines: The planners; by default those with a file ``config/*_planning.yaml``.
            load_all: Add the planners for which only MoveIt's default file exists, if `pipelines` is not given.

        Raises:
            RuntimeError: `default_planning_pipeline` is not one of the planners.
        """
        folder = self._package_path / _CONFIG_FOLDER
        names = list(get_pattern_matches(folder, "_planning.yaml") if pipelines is None else pipelines)
        if pipelines is None and load_all:
            names += [name for name in get_pattern_matches(_DEFAULTS, "_planning.yaml") if name not in names]
        default = default_planning_pipeline or ("ompl" if "ompl" in names or not names else names[0])
        if default not in names:
            raise RuntimeError(
                f"default_planning_pipeline: `{default}` doesn't name any of the input pipelines `{','.join(names)}`"
            )
        found: dict[str, Any] = {"planning_pipelines": names, "default_planning_pipeline": default}
        for name in names:
            own = folder / f"{name}_planning.yaml"
            found[name] = load_yaml(own if own.exists() else _DEFAULTS / own.name)
        if "ompl" in found and "planner_configs" not in found["ompl"]:
            found["ompl"].update(load_yaml(_DEFAULTS / "ompl_defaults.yaml"))
        self.__moveit_configs.planning_pipelines = found
        return self

    def pilz_cartesian_limits(self, file_path: str | None = None) -> MoveItConfigsBuilder:
        """Read the Cartesian limits of the Pilz planner, if the file exists.

        Args:
            file_path: The file, relative to the package; ``config/pilz_cartesian_limits.yaml`` by default.
        """
        path = self.__path(file_path, "pilz_cartesian_limits.yaml")
        if path.exists():
            self.__moveit_configs.pilz_cartesian_limits = {f"{self.__robot_description}_planning": load_yaml(path)}
        return self

    def to_moveit_configs(self) -> MoveItConfigs:
        """Return the parameters; files that no method has named are read now."""
        configs = self.__moveit_configs
        for name in (
            "robot_description",
            "robot_description_semantic",
            "robot_description_kinematics",
            "planning_pipelines",
            "trajectory_execution",
            "planning_scene_monitor",
            "sensors_3d",
            "joint_limits",
        ):
            if not getattr(configs, name):
                getattr(self, name)()
        if _PILZ_FILE in configs.planning_pipelines and not configs.pilz_cartesian_limits:
            self.pilz_cartesian_limits()
        return configs

    def to_dict(self, include_moveit_configs: bool = True) -> dict[str, Any]:
        """Return the parameters of this builder.

        Args:
            include_moveit_configs: Whether those of MoveIt are among them.
        """
        parameters = self._parameters
        if include_moveit_configs:
            parameters.update(self.to_moveit_configs().to_dict())
        return parameters


def get_pattern_matches(folder: Path, suffix: str) -> list[str]:
    """Return the names of the files of a folder with a suffix, without the suffix, in alphabetical order."""
    return sorted(path.name.removesuffix(suffix) for path in folder.glob(f"*{suffix}"))


def _description(path: Path, mappings: dict[Any, Any]) -> Any:
    """Return the XML of a file; it is expanded when the node starts if an argument is a substitution."""
    if all(isinstance(value, str) for value in mappings.values()):
        return load_xacro(path, mappings)
    return ParameterValue(Xacro(str(path), mappings=mappings), value_type=str)


def _warn(text: str) -> None:
    logging.getLogger("moveit_configs_utils").warning("%s", text)
