# SPDX-License-Identifier: Apache-2.0
"""The launch descriptions of a configuration package of MoveIt."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe._files.bounded_xml import read_xml
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from moveit_configs_utils.launch_utils import DeclareBooleanLaunchArg, add_debuggable_node

if TYPE_CHECKING:
    from moveit_configs_utils.moveit_configs_builder import MoveItConfigs

__all__ = [
    "generate_demo_launch",
    "generate_move_group_launch",
    "generate_moveit_rviz_launch",
    "generate_rsp_launch",
    "generate_setup_assistant_launch",
    "generate_spawn_controllers_launch",
    "generate_static_virtual_joint_tfs_launch",
    "generate_warehouse_db_launch",
]


def generate_rsp_launch(moveit_config: MoveItConfigs) -> LaunchDescription:
    """Return the launch description of robot_state_publisher."""
    return LaunchDescription(
        [
            DeclareLaunchArgument("publish_frequency", default_value="15.0"),
            Node(
                package="robot_state_publisher",
                executable="robot_state_publisher",
                respawn=True,
                output="screen",
                parameters=[
                    moveit_config.robot_description,
                    {"publish_frequency": LaunchConfiguration("publish_frequency")},
                ],
            ),
        ]
    )


def generate_moveit_rviz_launch(moveit_config: MoveItConfigs) -> LaunchDescription:
    """Return the launch description of RViz."""
    config = _find_package(moveit_config) / "config" / "moveit.rviz"
    description = LaunchDescription(
        [DeclareBooleanLaunchArg("debug"), DeclareLaunchArgument("rviz_config", default_value=str(config))]
    )
    add_debuggable_node(
        description,
        package="rviz2",
        executable="rviz2",
        output="log",
        respawn=False,
        arguments=["-d", LaunchConfiguration("rviz_config")],
        parameters=[
            moveit_config.planning_pipelines,
            moveit_config.robot_description_kinematics,
            moveit_config.joint_limits,
        ],
    )
    return description


def generate_setup_assistant_launch(moveit_config: MoveItConfigs) -> LaunchDescription:
    """Return the launch description of MoveIt's setup assistant."""
    description = LaunchDescription([DeclareBooleanLaunchArg("debug")])
    add_debuggable_node(
        description,
        package="moveit_setup_assistant",
        executable="moveit_setup_assistant",
        arguments=[f"--config_pkg={moveit_config.package_path}"],
    )
    return description


def generate_static_virtual_joint_tfs_launch(moveit_config: MoveItConfigs) -> LaunchDescription:
    """Return the launch description of the static transforms of the virtual joints in the SRDF."""
    (text,) = moveit_config.robot_description_semantic.values()
    joints = read_xml(io.BytesIO(text.encode())).iter("virtual_joint")
    return LaunchDescription(
        [
            Node(
                package="tf2_ros",
                executable="static_transform_publisher",
                name=f"static_transform_publisher{number}",
                output="log",
                arguments=[
                    "--frame-id",
                    joint.get("parent_frame", ""),
                    "--child-frame-id",
                    joint.get("child_link", ""),
                ],
            )
            for number, joint in enumerate(joints)
        ]
    )


def generate_spawn_controllers_launch(moveit_config: MoveItConfigs) -> LaunchDescription:
    """Return the launch description that starts the controllers."""
    manager = moveit_config.trajectory_execution.get("moveit_simple_controller_manager", {})
    return LaunchDescription(
        [
            Node(package="controller_manager", executable="spawner", arguments=[name], output="screen")
            for name in [*manager.get("controller_names", []), "joint_state_broadcaster"]
        ]
    )


def generate_warehouse_db_launch(moveit_config: MoveItConfigs) -> LaunchDescription:
    """Return the launch description of the database of planning scenes."""
    path = _find_package(moveit_config) / "default_warehouse_mongo_db"
    parameters = {
        "overwrite": False,
        "database_path": LaunchConfiguration("moveit_warehouse_database_path"),
        "warehouse_port": LaunchConfiguration("moveit_warehouse_port"),
        "warehouse_host": LaunchConfiguration("moveit_warehouse_host"),
        "warehouse_exec": "mongod",
        "warehouse_plugin": "warehouse_ros_mongo::MongoDatabaseConnection",
    }
    return LaunchDescription(
        [
            DeclareLaunchArgument("moveit_warehouse_database_path", default_value=str(path)),
            DeclareBooleanLaunchArg("reset"),
            DeclareLaunchArgument("moveit_warehouse_port", default_value="33829"),
            DeclareLaunchArgument("moveit_warehouse_host", default_value="localhost"),
            Node(package="warehouse_ros_mongo", executable="mongo_wrapper_ros.py", parameters=[parameters]),
            Node(
                package="moveit_ros_warehouse",
                executable="moveit_init_demo_warehouse",
                output="screen",
                condition=IfCondition(LaunchConfiguration("reset")),
            ),
        ]
    )


def generate_move_group_launch(moveit_config: MoveItConfigs) -> LaunchDescription:
    """Return the launch description of move_group."""
    capabilities = moveit_config.move_group_capabilities
    description = LaunchDescription(
        [
            DeclareBooleanLaunchArg("debug", default_value=False),
            DeclareBooleanLaunchArg("allow_trajectory_execution", default_value=True),
            DeclareBooleanLaunchArg("publish_monitored_planning_scene", default_value=True),
            DeclareLaunchArgument("capabilities", default_value=capabilities["capabilities"]),
            DeclareLaunchArgument("disable_capabilities", default_value=capabilities["disable_capabilities"]),
            DeclareBooleanLaunchArg("monitor_dynamics", default_value=False),
        ]
    )
    publishes = LaunchConfiguration("publish_monitored_planning_scene")
    parameters = {
        "publish_robot_description_semantic": True,
        "allow_trajectory_execution": LaunchConfiguration("allow_trajectory_execution"),
        "capabilities": ParameterValue(LaunchConfiguration("capabilities"), value_type=str),
        "disable_capabilities": ParameterValue(LaunchConfiguration("disable_capabilities"), value_type=str),
        "publish_planning_scene": publishes,
        "publish_geometry_updates": publishes,
        "publish_state_updates": publishes,
        "publish_transforms_updates": publishes,
        "monitor_dynamics": False,
    }
    add_debuggable_node(
        description,
        package="moveit_ros_move_group",
        executable="move_group",
        commands_file=str(_find_package(moveit_config) / "launch" / "gdb_settings.gdb"),
        output="screen",
        parameters=[moveit_config.to_dict(), parameters],
        extra_debug_args=["--debug"],
    )
    return description


def generate_demo_launch(moveit_config: MoveItConfigs, launch_package_path: Any = None) -> LaunchDescription:
    """Return the launch description of the whole demonstration: the other launch files, and simulated controllers.

    Args:
        moveit_config: The parameters.
        launch_package_path: Folder of the package with the launch files; that of the parameters by default.
    """
    package = Path(launch_package_path) if launch_package_path else _find_package(moveit_config)
    return LaunchDescription(
        [
            DeclareBooleanLaunchArg("db", default_value=False, description="whether to start the database"),
            DeclareBooleanLaunchArg("debug", default_value=False, description="whether nodes run in a debugger"),
            DeclareBooleanLaunchArg("use_rviz", default_value=True),
            *(
                [_include_launch_file(package, "static_virtual_joint_tfs")]
                if _find_file(package, "static_virtual_joint_tfs").exists()
                else []
            ),
            _include_launch_file(package, "rsp"),
            _include_launch_file(package, "move_group"),
            _include_launch_file(package, "moveit_rviz", condition=IfCondition(LaunchConfiguration("use_rviz"))),
            _include_launch_file(package, "warehouse_db", condition=IfCondition(LaunchConfiguration("db"))),
            Node(
                package="controller_manager",
                executable="ros2_control_node",
                parameters=[
                    moveit_config.robot_description,
                    str(_find_package(moveit_config) / "config" / "ros2_controllers.yaml"),
                ],
            ),
            _include_launch_file(package, "spawn_controllers"),
        ]
    )


def _find_package(moveit_config: MoveItConfigs) -> Path:
    return Path(moveit_config.package_path or ".")


def _find_file(package: Path, name: str) -> Path:
    return package / "launch" / f"{name}.launch.py"


def _include_launch_file(package: Path, name: str, **options: Any) -> IncludeLaunchDescription:
    return IncludeLaunchDescription(PythonLaunchDescriptionSource(str(_find_file(package, name))), **options)
