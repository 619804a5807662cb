# SPDX-License-Identifier: Apache-2.0
"""Parameters of nodes: their types, and the command line that a node is started with."""

import enum
import re
from pathlib import Path

import numpy as np
import pytest
import yaml

from launch import LaunchContext
from launch.actions import GroupAction
from launch.substitutions import LaunchConfiguration, TextSubstitution
from launch.utilities import visit_all_entities_and_collect_futures
from launch_ros.actions import Node, PushRosNamespace, SetParameter, SetParametersFromFile, SetRemap, SetUseSimTime
from launch_ros.descriptions import Parameter, ParameterFile, ParameterValue
from launch_ros.utilities import evaluate_parameter_dict, normalize_parameter_dict, prefix_namespace


class Mode(enum.IntEnum):
    FAST = 2


class Frame(str, enum.Enum):
    BASE = "base_link"


CONFIGURATIONS = {"five": "5", "half": "0.5", "yes": "true", "word": "hello", "list": "[1, 2]", "quoted": "'5'"}


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (5, 5),
        ("5", "5"),
        (TextSubstitution(text="5"), 5),
        (LaunchConfiguration("five"), 5),
        (LaunchConfiguration("half"), 0.5),
        (LaunchConfiguration("yes"), True),
        (LaunchConfiguration("list"), [1, 2]),
        (LaunchConfiguration("quoted"), "5"),
        (["robot", LaunchConfiguration("five")], "robot5"),
        ([LaunchConfiguration("five"), ".", LaunchConfiguration("five")], 5.5),
        (["a", "b"], ["a", "b"]),
        ([1, 2.5], [1.0, 2.5]),
        ([[LaunchConfiguration("word"), "1"], [TextSubstitution(text="x")]], ["hello1", "x"]),
        ((True, False), [True, False]),
        (Mode.FAST, 2),
        ([Mode.FAST, 3], [2, 3]),
        (Frame.BASE, "base_link"),
        ([Frame.BASE, "map"], ["base_link", "map"]),
        (np.int32(5), 5),
        (np.float32(0.5), 0.5),
        ([np.int64(5), np.int64(6)], [5, 6]),
        (np.bool_(True), True),
        (ParameterValue(LaunchConfiguration("five"), value_type=str), "5"),
        (ParameterValue(LaunchConfiguration("five"), value_type=float), 5.0),
        (ParameterValue(["[", LaunchConfiguration("five"), "]"], value_type=list[int]), [5]),
        (ParameterValue(LaunchConfiguration("word")), "hello"),
        (b"\x01\x02", [1, 2]),
        ([], []),
    ],
)
def test_types_of_values(context, value, expected):
    context.launch_configurations.update(CONFIGURATIONS)
    found = evaluate_parameter_dict(context, normalize_parameter_dict({"name": value}))
    assert found == {"name": expected}
    assert type(found["name"]) is type(expected)


def test_nested_dictionaries_have_dotted_names(context):
    context.launch_configurations["gains"] = "pid"
    nested = {LaunchConfiguration("gains"): {"p": 1, "inner": {"i": 2}}, "x": 3}
    assert evaluate_parameter_dict(context, normalize_parameter_dict(nested)) == {
        "pid.p": 1,
        "pid.inner.i": 2,
        "x": 3,
    }


def test_values_that_are_not_parameters(context):
    with pytest.raises(TypeError, match="the value of the parameter 'a' has the type object"):
        normalize_parameter_dict({"a": object()})
    with pytest.raises(TypeError, match="must have the same type, found int, str"):
        normalize_parameter_dict({"a": [1, "b"]})
    with pytest.raises(TypeError, match="If the parameter is meant to be a string, try wrapping it in"):
        evaluate_parameter_dict(context, normalize_parameter_dict({"a": TextSubstitution(text="{b: 1}")}))
    with pytest.raises(ValueError, match="Unable to parse the value of parameter a as yaml"):
        evaluate_parameter_dict(context, normalize_parameter_dict({"a": TextSubstitution(text="<a: [")}))
    with pytest.raises(TypeError, match="Expecting a sequence of parameters, got"):
        Node(executable="x", parameters={"a": 1})


@pytest.mark.parametrize(
    ("base", "namespace", "combined"),
    [
        (None, None, None),
        (None, "a", "a"),
        ("/a", None, "/a"),
        ("/a", "b", "/a/b"),
        ("/a/", "b/", "/a/b"),
        ("/a", "/b", "/b"),
        ("/", "a", "/a"),
        ("/a", "/", "/"),
    ],
)
def test_namespaces(base, namespace, combined):
    assert prefix_namespace(base, namespace) == combined


def command(*entities, configurations=None):
    """Return the command line of the last node, with the contents of parameter files instead of their paths."""
    context = LaunchContext()
    context.launch_configurations.update(configurations or {})
    context._set_is_shutdown(True)  # Nothing is started.
    for entity in entities:
        visit_all_entities_and_collect_futures(entity, context)
    node = entities[-1]
    while isinstance(node, GroupAction):
        node = [each for each in node.get_sub_entities() if isinstance(each, Node | GroupAction)][-1]
    words = list(node.cmd)
    return [
        yaml.safe_load(Path(word).read_text()) if before == "--params-file" else word
        for before, word in zip(["", *words], words, strict=False)
    ]


def test_command_line_of_a_node(tmp_path):
    file = tmp_path / "parameters.yaml"
    file.write_text("talker:\n  ros__parameters:\n    rate: 2\n")
    node = Node(
        executable="/bin/talker",
        name=["tal", "ker"],
        namespace="front",
        arguments=["--count", LaunchConfiguration("five")],
        ros_arguments=["--log-level", "debug"],
        parameters=[{"a": 1, "b": {"c": [True]}}, str(file), Parameter("d", LaunchConfiguration("word"))],
        remappings=[("chatter", "/news"), (["in", "put"], LaunchConfiguration("word"))],
    )
    assert command(node, configurations=CONFIGURATIONS) == [
        *("/bin/talker", "--count", "5", "--ros-args", "--log-level", "debug"),
        *("-r", "__node:=talker", "-r", "__ns:=/front"),
        "--params-file",
        {"/front/talker": {"ros__parameters": {"a": 1, "b.c": [True]}}},
        "--params-file",
        {"talker": {"ros__parameters": {"rate": 2}}},
        *("-p", "d:=hello", "-r", "chatter:=/news", "-r", "input:=hello"),
    ]
    assert node.node_name == "/front/talker"
    assert command(Node(executable="/bin/x")) == ["/bin/x", "--ros-args"]
    assert command(Node(executable="/bin/x", parameters=[{"a": "5"}])) == [
        *("/bin/x", "--ros-args", "--params-file"),
        {"/**": {"ros__parameters": {"a": "5"}}},
    ]


def test_settings_of_a_group_apply_to_its_nodes_only(tmp_path):
    file = tmp_path / "all.yaml"
    file.write_text("/**:\n  ros__parameters:\n    z: 1\n")
    inside = Node(executable="/bin/x", name="n", namespace="arm", parameters=[{"a": 2}], remappings=[("a", "b")])
    group = GroupAction(
        [
            PushRosNamespace("robot1"),
            SetParameter("a", 1),
            SetUseSimTime(True),
            SetParametersFromFile(str(file)),
            SetRemap("tf", "/tf"),
            GroupAction([PushRosNamespace("left"), SetParameter("deep", ["x", "y"]), inside]),
        ]
    )
    assert command(group) == [
        *("/bin/x", "--ros-args", "-r", "__node:=n", "-r", "__ns:=/robot1/left/arm"),
        *("-p", "a:=1", "-p", "use_sim_time:=True", "--params-file"),
        {"/**": {"ros__parameters": {"z": 1}}},
        *("-p", "deep:=['x', 'y']", "--params-file"),
        {"/robot1/left/arm/n": {"ros__parameters": {"a": 2}}},
        *("-r", "tf:=/tf", "-r", "a:=b"),
    ]
    group = GroupAction([PushRosNamespace("robot1"), SetParameter("a", 1), SetRemap("tf", "/tf")])
    assert command(group, Node(executable="/bin/x")) == ["/bin/x", "--ros-args"]


def test_substitutions_in_a_file_of_parameters(tmp_path, context):
    file = tmp_path / "parameters.yaml"
    file.write_text("/**:\n  ros__parameters:\n    name: $(var word)\n")
    context.launch_configurations.update(CONFIGURATIONS)
    performed = ParameterFile(str(file), allow_substs=True).evaluate(context)
    assert "name: hello" in performed.read_text()
    assert "name: $(var word)" in ParameterFile(str(file)).evaluate(context).read_text()


def test_a_missing_file_of_parameters_is_reported(capfd):
    assert command(Node(executable="/bin/x", parameters=["/no/such.yaml"])) == ["/bin/x", "--ros-args"]
    assert re.search(r"\[WARNING\] .*Parameter file path is not a file: /no/such.yaml", capfd.readouterr().out)
