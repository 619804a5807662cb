# SPDX-License-Identifier: Apache-2.0
"""Robots in a tab: checked descriptions, meshes but no other files, and joints."""

import time
import urllib.error
import urllib.request
from pathlib import Path

import pytest

import coframe
from coframe.viewer.robots.meshes import MeshError, MeshTable

URDF = """<robot name="arm">
  <link name="base"><visual><geometry><mesh filename="{mesh}"/></geometry></visual></link>
  <link name="tip"/> <link name="finger"/>
  <joint name="turn" type="revolute">
    <parent link="base"/> <child link="tip"/> <axis xyz="0 0 1"/>
    <limit lower="0.5" upper="1.5" effort="1" velocity="1"/>
  </joint>
  <joint name="grip" type="prismatic">
    <parent link="tip"/> <child link="finger"/> <axis xyz="1 0 0"/> <mimic joint="turn" multiplier="-0.5"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>"""


@pytest.fixture
def package(tmp_path):
    """Return a ROS package with meshes, next to files that must not be served."""
    folder = tmp_path / "ws" / "arm_description"
    (folder / "meshes").mkdir(parents=True)
    (folder / "textures").mkdir()
    (folder / "urdf").mkdir()
    (folder / "package.xml").write_text("<package><name>arm_description</name></package>")
    (folder / "meshes" / "base link.dae").write_text("<COLLADA/>")
    (folder / "textures" / "skin.png").write_bytes(b"png")
    (folder / "urdf" / "notes.txt").write_text("secret")
    (tmp_path / "outside.stl").write_text("secret")
    (folder / "meshes" / "link.stl").symlink_to(tmp_path / "outside.stl")
    (folder / "meshes" / "folder").symlink_to(tmp_path)
    (folder / "meshes" / "loop.stl").symlink_to(folder / "meshes" / "loop.stl")
    return folder


def fetch(viewer, url):
    with urllib.request.urlopen(viewer.url.rstrip("/") + url) as answer:
        return answer.headers["Content-Type"], answer.read()


def robot_file(package, mesh):
    file = package / "urdf" / "arm.urdf"
    file.write_text(URDF.replace("{mesh}", mesh))
    return file


def test_a_robot_from_a_file_has_its_meshes(package, view, open_tab):
    file = robot_file(package, "package://arm_description/meshes/base%20link.dae")
    viewer = view(coframe.Buffer(None), robot=file)
    robot = open_tab(viewer).wait("robot")
    assert (robot["name"], robot["source"], robot["description_topic"]) == ("arm", str(file), None)
    assert robot["problems"] == []
    assert [joint["name"] for joint in robot["joints"] if joint["value"] is not None] == ["turn"], "sliders"
    ((written, url),) = robot["meshes"].items()
    assert written == "package://arm_description/meshes/base%20link.dae"
    assert fetch(viewer, url) == ("model/vnd.collada+xml", b"<COLLADA/>")
    # Textures are in the folder of the mesh, however the page joins the names.
    for texture in (url.rsplit("/", 1)[0] + "/../textures/skin.png", url + "/../textures/skin.png"):
        assert fetch(viewer, texture) == ("image/png", b"png")


SHAPES = """<robot name="shapes">
  <material name="red"><color rgba="1 0 0 0.5"/></material>
  <link name="base">
    <visual><origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/><geometry><box size="1 2 3"/></geometry>
      <material name="red"/></visual>
    <visual><geometry><sphere radius="0.5"/></geometry>
      <material name="m"><texture filename="skin.png"/></material></visual>
    <visual><geometry><cylinder radius="0.1" length="2"/></geometry></visual>
    <visual><geometry><mesh filename="a.stl" scale="0.001 0.002 0.003"/></geometry></visual>
    <collision><origin xyz="0 0 1"/><geometry><capsule radius="0.2" length="3"/></geometry></collision>
  </link>
  <link name="tip"/><link name="finger"/>
  <joint name="lift" type="prismatic">
    <origin xyz="0 0 1"/><parent link="base"/><child link="tip"/><axis xyz="0 0 2"/>
    <limit lower="-1" upper="2" effort="1" velocity="1"/>
  </joint>
  <joint name="grip" type="continuous">
    <parent link="tip"/><child link="finger"/><mimic joint="lift" multiplier="2" offset="0.5"/>
  </joint>
</robot>"""


def shape(kind, size, pose=(0, 0, 0, 0, 0, 0, 1), mesh=None, color=None, texture=None):
    return {
        "kind": kind,
        "size": size,
        "pose": pytest.approx(list(pose)),
        "mesh": mesh,
        "color": color,
        "texture": texture,
    }


def test_the_page_receives_links_and_joints_and_no_urdf(tmp_path, view, open_tab):
    (tmp_path / "shapes.urdf").write_text(SHAPES)
    (tmp_path / "a.stl").write_bytes(b"solid")
    (tmp_path / "skin.png").write_bytes(b"png")
    robot = open_tab(view(coframe.Buffer(None), robot=tmp_path / "shapes.urdf")).wait("robot")
    assert "<link" not in str(robot)
    assert (robot["root"], robot["meshes"].keys()) == ("base", {"a.stl", "skin.png"})
    base, tip, finger = robot["links"]
    turned = (1, 2, 3, 0, 0, 0.5**0.5, 0.5**0.5)
    assert base["visuals"] == [
        shape("box", [1, 2, 3], turned, color=[1, 0, 0, 0.5]),
        shape("sphere", [0.5], texture="skin.png"),
        shape("cylinder", [0.1, 2]),
        shape("mesh", [0.001, 0.002, 0.003], mesh="a.stl"),
    ]
    assert base["collisions"] == [shape("capsule", [0.2, 3], (0, 0, 1, 0, 0, 0, 1))]
    assert (tip["visuals"], finger["name"]) == ([], "finger")
    lift, grip = robot["joints"]
    assert lift == {
        "name": "lift",
        "type": "prismatic",
        "parent": "base",
        "child": "tip",
        "origin": [0, 0, 1, 0, 0, 0, 1],
        "axis": [0, 0, 1],
        "mimic": None,
        "lower": -1,
        "upper": 2,
        "effort": 1.0,
        "value": 0,
    }
    assert (grip["axis"], grip["lower"], grip["value"]) == ([1, 0, 0], None, None)
    assert grip["mimic"] == {"joint": "lift", "multiplier": 2, "offset": 0.5}


def test_warnings_about_a_description_are_not_problems(package, view, open_tab):
    file = robot_file(package, "package://arm_description/meshes/base%20link.dae")
    unusual = """<link name="unusual">
        <visual><geometry><sphere radius="1"/></geometry><material name="nowhere"/></visual>
      </link>
      <joint name="to_unusual" type="fixed"><parent link="base"/><child link="unusual"/></joint>"""
    file.write_text(file.read_text().replace("</robot>", unusual + "</robot>"))
    robot = open_tab(view(coframe.Buffer(None), robot=file)).wait("robot")
    assert robot["problems"] == []
    assert len(robot["warnings"]) == 1
    assert "nowhere" in robot["warnings"][0]


@pytest.mark.parametrize(
    "mesh",
    [
        "package://arm_description/../../outside.stl",
        "package://arm_description/%2e%2e/%2e%2e/outside.stl",
        "package://arm_description/meshes/link.stl",
        "package://arm_description/meshes/folder/outside.stl",
        "package://arm_description/meshes/loop.stl",
        "package://arm_description//etc/passwd",
        "package://arm_description/urdf/notes.txt",
        "package://../outside.stl",
        "package://no_such_package/x.stl",
        "file:///etc/passwd",
        "file://elsewhere/x.stl",
        "http://example.org/x.stl",
        "../../../outside.stl",
        "/etc/passwd",
        "x" * 5000 + ".stl",
    ],
)
def test_other_files_are_rejected_with_a_message(package, view, open_tab, mesh):
    viewer = view(coframe.Buffer(None), robot=robot_file(package, mesh))
    robot = open_tab(viewer).wait("robot")
    assert robot["meshes"] == {}
    assert len(robot["problems"]) == 1
    assert len(robot["problems"][0]) < 300


def test_of_many_problems_the_first_are_shown_and_the_others_counted(tmp_path, view, open_tab):
    meshes = "".join(
        f'<link name="l{i}"><visual><geometry><mesh filename="{i}.stl"/></geometry></visual></link>' for i in range(60)
    )
    joints = "".join(
        f'<joint name="j{i}" type="fixed"><parent link="l0"/><child link="l{i}"/></joint>' for i in range(1, 60)
    )
    file = tmp_path / "many.urdf"
    file.write_text(f'<robot name="many">{meshes}{joints}</robot>')
    robot = open_tab(view(coframe.Buffer(None), robot=file)).wait("robot")
    assert len(robot["problems"]) == 51
    assert robot["problems"][-1] == "... and 10 more"


def test_no_url_leads_outside_the_served_folders(package, view, open_tab):
    robot = robot_file(package, "package://arm_description/meshes/base link.dae")
    viewer = view(coframe.Buffer(None), robot=robot)
    (url,) = open_tab(viewer).wait("robot")["meshes"].values()
    root = "/".join(url.split("/")[:3])
    for path in (
        f"{root}/meshes/link.stl",
        f"{root}/../outside.stl",
        f"{root}/%2e%2e/%2e%2e/outside.stl",
        f"{root}/meshes/folder/outside.stl",
        f"{root}//etc/passwd",
        f"{root}/urdf/notes.txt",
        f"{root}/package.xml",
        f"{root}/",
        root,
        f"{root}x/meshes/base%20link.dae",
        f"{url}/../../../outside.stl",
    ):
        with pytest.raises(urllib.error.HTTPError) as refused:
            fetch(viewer, path)
        with refused.value:
            assert refused.value.code == 404, path
            assert b"secret" not in refused.value.read()


def test_declared_folders_and_the_size_limit(tmp_path, monkeypatch):
    (tmp_path / "a.stl").write_bytes(b"x" * 2000)
    with pytest.raises(MeshError, match="is outside the served folders"):
        MeshTable(lambda _name: None).url(f"file://{tmp_path}/a.stl")
    table = MeshTable(lambda _name: None, [tmp_path])
    url = table.url(f"file://{tmp_path}/a.stl")
    assert table.file(url.removeprefix("/mesh/")) == (tmp_path / "a.stl").resolve()
    assert table.url_or_problem("package://[/a.stl") == (None, "'package://[/a.stl' is not a valid address")
    assert table.url_or_problem("relative.stl") == (None, "'relative.stl' is neither package:// nor file://")
    monkeypatch.setattr("coframe.viewer.robots.meshes.MAX_MESH_BYTES", 1000)
    with pytest.raises(MeshError, match="MB are served"):
        table.url(f"file://{tmp_path}/a.stl")


BOMB = """<!DOCTYPE robot [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">
<!ENTITY c "&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;">]><robot name="&c;"><link name="base"/></robot>"""


def test_an_invalid_robot_description_gives_a_message(tmp_path):
    for text in (BOMB, "<sdf/>", "nothing", URDF.replace('child link="tip"', 'child link="base"')):
        (tmp_path / "bad.urdf").write_text(text)
        with pytest.raises(coframe.RobotDescriptionError, match=r"bad\.urdf"):
            coframe.show(coframe.Buffer(), port=0, robot=tmp_path / "bad.urdf")


@pytest.mark.parametrize(("options", "topic"), [({}, "/joint_states"), ({"joint_states": "/sliders"}, "/sliders")])
def test_descriptions_are_received_and_joint_states_published(domain_id, view, open_tab, options, topic):
    pytest.importorskip("dds_library", reason="topics need DDS")
    from coframe.messages import find
    from coframe.wire.qos import QoS

    text = find("std_msgs/msg/String")
    with coframe.connect("viewer_test", domain=domain_id) as ros:
        publisher = ros.publisher("/robot_description", text, QoS(1, transient_local=True))
        tab = open_tab(view(ros, **options))
        publisher.publish(text(data=BOMB))
        problem = tab.wait("problem")
        assert problem["text"].startswith("/robot_description contains no valid robot description: ")
        publisher.publish(text(data=URDF.replace("{mesh}", "package://none/x.dae")))
        robot = tab.wait("robot")
        assert (robot["name"], robot["description_topic"]) == ("arm", "/robot_description")
        assert robot["problems"] == [
            "ROS package 'none' not found. Add the folder that contains it to COFRAME_PACKAGE_PATH."
        ]

        joint_states = ros.subscribe(topic, find("sensor_msgs/msg/JointState"))
        tab.send("joints", robot=robot["id"], positions={"turn": 1.0}, publish=True)
        for _ in range(2):  # robot_state_publisher needs them repeatedly.
            state = joint_states.receive("10s")
            assert dict(zip(state.name, state.position, strict=True)) == {"turn": 1.0, "grip": -0.5}
        assert abs(state.header.stamp.sec - time.time()) < 10
        tab.send("joints", robot=robot["id"], positions={"elbow": 1.0}, publish=True)
        assert "No joint named 'elbow'" in tab.wait("problem")["text"]
        tab.send("joints", robot=robot["id"], positions={"turn": float("nan")}, publish=True)
        assert "not valid JSON" in tab.wait("problem")["text"]
        tab.send("joints", robot=robot["id"], positions={}, publish=False)
        tab.wait("stats")
        while joint_states.receive("300ms") is not None:
            pass


def test_joint_states_need_a_live_graph(package, view, open_tab):
    file = robot_file(package, "package://arm_description/meshes/base link.dae")
    tab = open_tab(view(coframe.Buffer(None), robot=Path(file)))
    tab.wait("robot")
    tab.send("joints", robot=0, positions={"turn": 1.0}, publish=True)
    assert "joint states can only be published on a live ROS graph" in tab.wait("problem")["text"]


def test_the_meshes_of_the_lab_are_complete_and_small(view, open_tab):
    arm = Path(coframe.__file__).with_name("lab") / "two_link_arm.urdf.xacro"
    pytest.importorskip("xacro", reason="the robot of the lab is a xacro file")
    viewer = view(coframe.Buffer(None), robot=arm)
    robot = open_tab(viewer).wait("robot")
    assert robot["problems"] == []
    names = {reference.rpartition("/")[2] for reference in robot["meshes"]}
    assert names == {f"{name}.glb" for name in ("base", "beam", "camera", "gripper", "imu", "joint", "lidar")}
    files = [fetch(viewer, url) for url in robot["meshes"].values()]
    contents = [body for _, body in files]
    assert all(content.startswith(b"glTF") for content in contents)
    assert sum(map(len, contents)) < 150_000
