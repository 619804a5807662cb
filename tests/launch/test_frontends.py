# SPDX-License-Identifier: Apache-2.0
"""XML and YAML launch files: elements, attributes, and errors that name them."""

from pathlib import Path

import pytest

from coframe._process.python_children import python_command
from launch import LaunchContext
from launch.actions import IncludeLaunchDescription, OpaqueFunction
from launch.frontend import Entity, expose_action
from launch.utilities import visit_all_entities_and_collect_futures
from launch_ros.actions import Node
from launch_xml.launch_description_sources import XMLLaunchDescriptionSource
from launch_yaml.launch_description_sources import YAMLLaunchDescriptionSource

XML = """
<launch>
  <arg name="robot" default="rover" description="which one">
    <choice value="rover"/><choice value="arm"/>
  </arg>
  <let name="size" value="$(eval '2 * 3')"/>
  <set_env name="COFRAME_X" value="$(var size)"/>
  <append_env name="COFRAME_X" value="y" separator=":"/>
  <group scoped="true">
    <push_ros_namespace namespace="$(var robot)"/>
    <set_parameter name="common" value="1.5"/>
    <set_remap from="a" to="b"/>
    <set_use_sim_time value="false"/>
    <node pkg="demo_nodes_py" exec="talker" name="n" namespace="inner" args="--x 'a b' $(var size)"
          output="screen" respawn="false" emulate_tty="true" on_exit="shutdown" if="$(equals $(var robot) rover)">
      <param name="number" value="5"/>
      <param name="text" value="'5'"/>
      <param name="computed" value="$(var size)"/>
      <param name="several" value="1;2" value-sep=";"/>
      <param name="pid"><param name="p" value="0.5"/></param>
      <remap from="chatter" to="/news"/>
      <env name="LEVEL" value="$(env COFRAME_X)"/>
    </node>
    <node pkg="demo_nodes_py" exec="listener" unless="true"/>
  </group>
  <for_each values="{name: 'x', n: 1};{name: 'y', n: 2}"><log message="$(for-var name)$(for-var n)"/></for_each>
  <for len="2" name="i"><log message="i=$(index i)"/></for>
  <timer period="0.5"><log message="later"/></timer>
  <executable cmd="echo 'one word' $(var robot)" name="said" shell="false"/>
  <unset name="size"/>
  <shutdown reason="end"/>
</launch>
"""

YAML = """
launch:
- arg: {name: robot, default: rover, choice: [{value: rover}, {value: arm}]}
- let: {name: size, value: "$(eval '2 * 3')"}
- set_env: {name: COFRAME_X, value: $(var size)}
- append_env: {name: COFRAME_X, value: y, separator: ':'}
- group:
    scoped: true
    children:
    - push_ros_namespace: {namespace: $(var robot)}
    - set_parameter: {name: common, value: 1.5}
    - set_remap: {from: a, to: b}
    - set_use_sim_time: {value: false}
    - node:
        pkg: demo_nodes_py
        exec: talker
        name: n
        namespace: inner
        args: --x 'a b' $(var size)
        output: screen
        on_exit: shutdown
        if: $(equals $(var robot) rover)
        param:
        - {name: number, value: 5}
        - {name: text, value: '5'}
        - {name: computed, value: $(var size)}
        - {name: several, value: [1, 2]}
        - {name: pid, param: [{name: p, value: 0.5}]}
        remap: [{from: chatter, to: /news}]
        env: [{name: LEVEL, value: $(env COFRAME_X)}]
    - node: {pkg: demo_nodes_py, exec: listener, unless: true}
- for_each: {values: "{name: 'x', n: 1};{name: 'y', n: 2}", children: [{log: {message: $(for-var name)$(for-var n)}}]}
- for: {len: 2, name: i, children: [{log: {message: i=$(index i)}}]}
- timer: {period: 0.5, children: [{log: {message: later}}]}
- executable: {cmd: "echo 'one word' $(var robot)", name: said, shell: false}
- unset: {name: size}
- shutdown: {reason: end}
"""


@pytest.mark.parametrize("text", [XML, YAML], ids=["xml", "yaml"])
def test_all_elements(parse, tmp_path, capfd, monkeypatch, text):
    description = parse(text, tmp_path)
    found = []

    def keep(self, context):
        self._perform_substitutions(context)
        self.prepare(context)
        found.append(self)

    monkeypatch.setattr("launch.actions.ExecuteLocal.execute", keep)
    monkeypatch.setattr(Node, "execute", keep)
    monkeypatch.setattr("launch.actions.TimerAction.execute", lambda self, _: self.actions)
    monkeypatch.setattr("launch.actions.ExecuteProcess._perform_substitutions", lambda *_: None, raising=False)
    context = LaunchContext()
    visit_all_entities_and_collect_futures(description, context)
    lines = capfd.readouterr().out.splitlines()
    assert lines == [f"[INFO] [launch.user]: {each}" for each in ("x1", "y2", "i=0", "i=1", "later")]
    node, process = found
    assert node.node_name == "/rover/inner/n"
    command = node.cmd
    module = command.index("demo_nodes_py.talker:main")
    assert command[:module] == python_command("coframe.workspace.entry_point")
    assert command[module + 1 : module + 5] == ["--x", "a b", "6", "--ros-args"]
    assert "common:=1.5" in command
    assert "use_sim_time:=False" in command
    assert command[-4:] == ["-r", "a:=b", "-r", "chatter:=/news"]
    assert node.env["LEVEL"] == "6:y"
    import yaml

    file = Path(command[command.index("--params-file") + 1])
    parameters = yaml.safe_load(file.read_text())["/rover/inner/n"]["ros__parameters"]
    assert parameters == {"number": 5, "text": "5", "computed": 6, "several": [1, 2], "pid.p": 0.5}
    assert process.cmd == ["echo", "one word", "rover"]
    assert context._event_queue.qsize() == 1
    assert [argument.choices for argument in description.get_launch_arguments()] == [["rover", "arm"]]
    assert "ros_namespace" not in context.launch_configurations


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<launch><nodee pkg='a' exec='b'/></launch>", "Unrecognized entity of the type: nodee. Did you mean 'node'?"),
        ("<launch><node pkg='a'/></launch>", "<node>: Attribute 'exec' not found in 'node'; attributes there: pkg"),
        (
            "<launch><node pkg='a' exec='b' naem='c'/></launch>",
            r"Unexpected attribute\(s\) found in `node`: \['naem'\]",
        ),
        ("<launch><node exec='b'><parm/></node></launch>", r"Unexpected nested entity\(ies\) found in `node`"),
        (
            "<launch><node exec='b'><param value='1'/></node></launch>",
            "param Entity should have name or from attribute",
        ),
        ("<launch><node exec='b' respawn='[1'/></launch>", "Failed to convert|invalid condition|respawn"),
        ("<launch><let name='x' value='$(vra y)'/></launch>", r"<let>: Unknown substitution: \$\(vra"),
        ("<launch><log message='x' if='1' unless='0'/></launch>", "if and unless conditions can't be used simult"),
        ("<launch><node exec='b' on_exit='respawn'/></launch>", "on_exit of Entity node expected to be `shutdown`"),
        ("<robot/>", "Expected 'launch' as root of the launch file, found 'robot'"),
        ("<launch><node", "not valid XML"),
        ("launch:\n- nodee: {}", "Unrecognized entity of the type: nodee"),
        ("launch:\n- node: {pkg: a, exec: b, naem: c}", r"Unexpected key\(s\) found in `node`: \['naem'\]"),
        ("launch:\n- group: {scoped: true}", "Expected entity `group` to have children entities"),
        ("launch:\n- node\n", "must be like '- node: ...', found 'node'"),
        ("launch:\n- node: {exec: b, param: 5}", "'param' of 'node' must be a list of keys and values, found 5"),
        ("launch: [", "invalid YAML"),
        ("[1, 2]", "expected one root 'launch:'"),
    ],
)
def test_errors_name_the_file_and_the_element(tmp_path, text, message):
    is_xml = text.startswith("<")
    file = tmp_path / ("broken.launch.xml" if is_xml else "broken.launch.yaml")
    file.write_text(text)
    source = (XMLLaunchDescriptionSource if is_xml else YAMLLaunchDescriptionSource)(str(file))
    with pytest.raises(Exception, match=message) as caught:
        visit_all_entities_and_collect_futures(IncludeLaunchDescription(source), LaunchContext())
    assert str(file) in str(caught.value) or "respawn" in text


def test_users_may_add_elements(parse, tmp_path, capfd):
    @expose_action("greet")
    def parse_greeting(entity: Entity, parser):
        name = parser.parse_substitution(entity.get_attr("name"))
        count = entity.get_attr("count", data_type=int)
        return OpaqueFunction, {"function": lambda context: print(name[0].perform(context) * count)}

    description = parse("<launch><greet name='hello' count='2'/></launch>", tmp_path)
    visit_all_entities_and_collect_futures(description, LaunchContext())
    assert capfd.readouterr().out == "hellohello\n"
