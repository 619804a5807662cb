# SPDX-License-Identifier: Apache-2.0
"""moveit_configs_utils and launch_param_builder, on a configuration package as MoveIt's setup assistant writes it."""

import math
from pathlib import Path

import pytest

from launch import LaunchContext
from launch.substitutions import LaunchConfiguration
from launch_param_builder import ParameterBuilder, ParameterBuilderFileNotFoundError, load_yaml
from launch_ros.actions import Node
from moveit_configs_utils import MoveItConfigsBuilder
from moveit_configs_utils.launches import (
    generate_demo_launch,
    generate_move_group_launch,
    generate_moveit_rviz_launch,
    generate_rsp_launch,
    generate_setup_assistant_launch,
    generate_spawn_controllers_launch,
    generate_static_virtual_joint_tfs_launch,
    generate_warehouse_db_launch,
)

pytest.importorskip("xacro")

URDF = '<robot name="arm" xmlns:xacro="http://ros.org/xacro"><xacro:arg name="side" default="left"/>'
URDF += '<link name="$(arg side)_base"/></robot>'
SRDF = '<robot name="arm"><virtual_joint name="v" type="fixed" parent_frame="world" child_link="base"/></robot>'
FILES = {
    ".setup_assistant": "moveit_setup_assistant_config:\n  urdf: {package: arm_description, relative_path: arm.xacro, "
    "xacro_args: side:=right}\n  srdf: {relative_path: config/arm.srdf}\n",
    "config/arm.srdf": SRDF,
    "config/kinematics.yaml": "arm: {kinematics_solver: kdl}\n",
    "config/joint_limits.yaml": "joint_limits: {j: {max_velocity: 2.0, max_position: !degrees 180}}\n",
    "config/moveit_controllers.yaml": "moveit_simple_controller_manager: {controller_names: [arm_controller]}\n",
    "config/ros2_controllers.yaml": "controller_manager: {}\n",
    "config/pilz_cartesian_limits.yaml": "cartesian_limits: {max_trans_vel: 1.0}\n",
    "config/ompl_planning.yaml": "planning_plugins: [mine]\n",
}


@pytest.fixture
def package(tmp_path, monkeypatch):
    """The configuration package of a robot, next to the package with its description."""
    monkeypatch.setenv("COFRAME_PACKAGE_PATH", str(tmp_path))
    folder = tmp_path / "arm_moveit_config"
    for name, text in {**FILES, "../arm_description/arm.xacro": URDF}.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    for name in ("arm_moveit_config", "arm_description"):
        text = f"<package format='3'><name>{name}</name><version>0.0.0</version></package>"
        (tmp_path / name / "package.xml").write_text(text)
    return folder


@pytest.mark.usefixtures("package")
def test_all_files_are_found_by_convention():
    found = MoveItConfigsBuilder("arm").to_dict()
    assert '<link name="right_base"/>' in found["robot_description"]
    assert "virtual_joint" in found["robot_description_semantic"]
    assert found["robot_description_kinematics"] == {"arm": {"kinematics_solver": "kdl"}}
    assert found["moveit_manage_controllers"] is True
    assert found["moveit_simple_controller_manager"] == {"controller_names": ["arm_controller"]}
    assert found["publish_planning_scene"] is True
    planning = found["robot_description_planning"]
    assert planning["joint_limits"]["j"] == {"max_velocity": 2.0, "max_position": pytest.approx(math.pi)}
    assert planning["cartesian_limits"] == {"max_trans_vel": 1.0}
    assert found["default_planning_pipeline"] == "ompl"
    assert found["planning_pipelines"] == ["ompl", "chomp", "pilz_industrial_motion_planner", "stomp"]
    assert found["ompl"]["planning_plugins"] == ["mine"]
    assert "RRTConnectkConfigDefault" in found["ompl"]["planner_configs"]


def test_files_and_arguments_that_are_given(package):
    configs = (
        MoveItConfigsBuilder("arm", package_name="arm_moveit_config")
        .robot_description(mappings={"side": "left"})
        .trajectory_execution("config/ros2_controllers.yaml", moveit_manage_controllers=False)
        .planning_pipelines(pipelines=["pilz_industrial_motion_planner"])
        .planning_scene_monitor(publish_robot_description=True)
        .to_moveit_configs()
    )
    assert '<link name="left_base"/>' in configs.robot_description["robot_description"]
    assert configs.trajectory_execution == {"moveit_manage_controllers": False, "controller_manager": {}}
    assert configs.planning_pipelines["default_planning_pipeline"] == "pilz_industrial_motion_planner"
    assert configs.to_dict()["publish_robot_description"] is True
    assert configs.package_path == str(package)


@pytest.mark.usefixtures("package")
def test_arguments_of_xacro_may_be_substitutions():
    builder = MoveItConfigsBuilder("arm").robot_description(mappings={"side": LaunchConfiguration("side")})
    context = LaunchContext()
    context.launch_configurations["side"] = "upper"
    value = builder.to_moveit_configs().robot_description["robot_description"]
    assert '<link name="upper_base"/>' in value.evaluate(context)


def test_mistakes_are_errors_with_names(package, caplog):
    with pytest.raises(RuntimeError, match="`lerp` doesn't name any of the input pipelines `ompl,chomp,"):
        MoveItConfigsBuilder("arm").planning_pipelines("lerp")
    (package / "config/moveit_controllers.yaml").rename(package / "config/other_controllers.yaml")
    with pytest.raises(RuntimeError, match="Unable to guess which parameter file to load") as error:
        MoveItConfigsBuilder("arm").trajectory_execution()
    assert " - other_controllers.yaml" in str(error.value)
    with pytest.raises(ParameterBuilderFileNotFoundError, match=r"none\.yaml doesn't exist"):
        MoveItConfigsBuilder("arm").joint_limits("config/none.yaml")
    with pytest.raises(KeyError, match="nothing_moveit_config"):
        MoveItConfigsBuilder("nothing")
    (package / ".setup_assistant").unlink()
    MoveItConfigsBuilder("arm").robot_description()
    assert "Cannot infer URDF" in caplog.text
    assert "will be loaded from /robot_description" in caplog.text


def nodes(description):
    found, pending = [], list(description.entities)
    while pending:
        entity = pending.pop(0)
        pending += entity.describe_sub_entities()
        found += [entity] if isinstance(entity, Node) else []
    return [(node.node_package[0].text, node.node_executable[0].text) for node in found]


def test_launch_descriptions(package):
    configs = MoveItConfigsBuilder("arm").to_moveit_configs()
    assert nodes(generate_rsp_launch(configs)) == [("robot_state_publisher", "robot_state_publisher")]
    assert nodes(generate_move_group_launch(configs)) == [("moveit_ros_move_group", "move_group")] * 2
    assert nodes(generate_moveit_rviz_launch(configs)) == [("rviz2", "rviz2")] * 2
    assert nodes(generate_static_virtual_joint_tfs_launch(configs)) == [("tf2_ros", "static_transform_publisher")]
    assert nodes(generate_spawn_controllers_launch(configs)) == [("controller_manager", "spawner")] * 2
    assert len(nodes(generate_warehouse_db_launch(configs))) == 2
    assert len(nodes(generate_setup_assistant_launch(configs))) == 2
    for name in ("rsp", "move_group", "moveit_rviz", "warehouse_db", "spawn_controllers", "static_virtual_joint_tfs"):
        file = package / "launch" / f"{name}.launch.py"
        file.parent.mkdir(exist_ok=True)
        file.write_text(
            "from moveit_configs_utils import MoveItConfigsBuilder\n"
            f"from moveit_configs_utils.launches import generate_{name}_launch\n"
            "def generate_launch_description():\n"
            f"    return generate_{name}_launch(MoveItConfigsBuilder('arm').to_moveit_configs())\n"
        )
    found = nodes(generate_demo_launch(configs))
    assert ("controller_manager", "ros2_control_node") in found
    assert ("moveit_ros_move_group", "move_group") in found


def test_parameters_of_a_node(package):
    (package / "text.txt").write_text("hello")
    builder = ParameterBuilder("arm_moveit_config").yaml("config/kinematics.yaml", "kinematics")
    builder = builder.file_parameter("text", "text.txt").parameter("rate", 5).yaml("config/ros2_controllers.yaml")
    found = builder.xacro_parameter("model", "../arm_description/arm.xacro", {"side": "front"}).to_dict()
    assert found["kinematics"] == {"arm": {"kinematics_solver": "kdl"}}
    assert (found["text"], found["rate"], found["controller_manager"]) == ("hello", 5, {})
    assert '<link name="front_base"/>' in found["model"]


def test_angles_in_degrees_and_radians(tmp_path):
    file = Path(tmp_path, "angles.yaml")
    file.write_text("a: !degrees 90\nb: !radians 1.5\nc: 10\n")
    assert load_yaml(file) == {"a": pytest.approx(math.pi / 2), "b": 1.5, "c": 10}
    file.write_text("a: !degrees x\n")
    with pytest.raises(ValueError, match=r"angles\.yaml is not valid YAML: could not convert string to float"):
        load_yaml(file)
