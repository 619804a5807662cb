# SPDX-License-Identifier: Apache-2.0
"""Displays: .rviz files, scans, robots and their joints."""

import struct
import time

import numpy as np
import pytest

import coframe
from coframe.lab.simulated_lidar import (
    HALL_HALF_WIDTH,
    HALL_START,
    PILLAR_OFFSET,
    PILLAR_RADIUS,
    PILLAR_SPACING,
)
from coframe.messages import find

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND


def test_the_rviz_file_of_the_lab_is_applied(demo, view, open_page, shared):
    page = open_page(view(demo.ros, rviz=shared / "lab" / "rviz_config.yaml").url).drawn()
    page.until("coframe.fixed === 'base_link'")
    page.tab("displays")
    page.wait(lambda: page.texts("#body-displays .card-title span:first-child") == ["TF", "RobotModel", "World Axes"])
    shown = page.evaluate("coframe.displays")
    assert {name: (display["class"], display["enabled"]) for name, display in shown.items()} == {
        "TF": ("TF", True),
        "RobotModel": ("RobotModel", True),
        "World Axes": ("Axes", True),
    }
    assert shown["RobotModel"]["state"] == "waiting"
    page.click("#body-displays .card[data-display=TF] .card-title")
    assert page.raw.input_value("#body-displays input[aria-label='Marker Scale']") == "0.3"


def test_unsupported_parts_of_an_rviz_file_are_listed_and_preserved(view, open_page, tmp_path):
    yaml = pytest.importorskip("yaml", reason="RViz's files are YAML")
    configuration = {
        "Panels": [{"Class": "rviz_common/Displays", "Name": "Displays", "Splitter Ratio": 0.4}],
        "Visualization Manager": {
            "Displays": [
                {
                    "Class": "rviz_default_plugins/TF",
                    "Name": "TF",
                    "Enabled": True,
                    "Marker Scale": 2,
                    "Unknown": {"a": [1]},
                },
                {"Class": "acme_plugins/Lasso", "Name": "A lasso <b>", "Enabled": True, "Length": 7},
            ],
            "Global Options": {"Fixed Frame": "map", "Background Color": "1; 2; 3", "Unknown Option": "kept"},
            "Tools": [{"Class": "rviz_default_plugins/Select"}],
        },
        "Window Geometry": {"Height": 800},
    }
    file = tmp_path / "my.rviz"
    file.write_text(yaml.safe_dump(configuration))
    buffer = coframe.Buffer(None)
    buffer.set("map", "base", coframe.Transform([1.0, 0.0, 0.0]), BEGIN)
    page = open_page(view(buffer).url).drawn()
    page.tab("rviz")
    page.raw.set_input_files("#body-rviz input[type=file]", file)
    page.wait(lambda: page.texts("#unknown li"), "the list of unsupported parts")
    assert "A lasso <b>" in page.text("#unknown")
    page.raw.select_option("#fixed", "base")
    with page.raw.expect_download() as download:
        page.click("#save-rviz")
    saved = yaml.safe_load(download.value.path().read_text())
    manager = saved["Visualization Manager"]
    assert (saved["Panels"], saved["Window Geometry"]) == (configuration["Panels"], configuration["Window Geometry"])
    assert manager["Tools"] == configuration["Visualization Manager"]["Tools"]
    assert configuration["Visualization Manager"]["Displays"][1] in manager["Displays"]
    tf = next(display for display in manager["Displays"] if display["Name"] == "TF")
    assert (tf["Marker Scale"], tf["Unknown"]) == (2, {"a": [1]})
    assert manager["Global Options"]["Fixed Frame"] == "base"
    assert manager["Global Options"]["Unknown Option"] == "kept"


def test_a_scan_of_the_demo_lies_on_its_walls(lab):
    lab.raw.select_option("#fixed", "odom")
    scan = lab.until(
        """() => {
            const display = Object.values(coframe.displays).find((one) => one.topic === '/scan');
            return coframe.frames.odom?.position.every((x) => x === 0) && display?.messages?.[0];
        }"""
    )
    assert_on_the_walls(scan)
    robot = lab.until("() => { const r = coframe.displays.RobotModel; return r?.meshes > 20 && !r.loading && r }")
    assert (robot["state"], robot["text"], robot["robot"]) == ("ok", "two_link_arm", "two_link_arm")
    link = lab.evaluate("[coframe.displays.RobotModel.links.gripper_link, coframe.frames.gripper_link.position]")
    np.testing.assert_allclose(link[0][:3], link[1], atol=0.05)  # The scene may have another origin in a long run.


def assert_on_the_walls(scan):
    """Assert that a scan in frame odom lies on the walls and pillars of the demo's hall."""
    points = np.array(scan["first"]).reshape(-1, 3)
    assert 100 < len(points) == scan["points"]
    x, y, _ = (rotation(scan["quaternion"]) @ points.T) + np.array(scan["position"])[:, None]
    number = np.round(x / PILLAR_SPACING)
    side = np.where(number % 2 == 0, PILLAR_OFFSET, -PILLAR_OFFSET)
    pillars = np.abs(np.hypot(x - number * PILLAR_SPACING, y - side) - PILLAR_RADIUS)
    walls = np.minimum(np.abs(np.abs(y) - HALL_HALF_WIDTH), np.abs(x - HALL_START))
    # The lidar measures from its last received pose, a few milliseconds before its stamp.
    distances = np.minimum(pillars, walls)
    assert np.quantile(distances, 0.95) < 0.05
    assert (pillars < 0.05).sum() > 3
    assert (walls < 0.05).sum() > 50


@pytest.mark.slow
def test_a_replay_of_the_demo_shows_scans_at_their_recorded_poses(lab, open_page, tmp_path):
    lab.raw.select_option("#fixed", "odom")
    lab.until("coframe.frames.odom.position.every((x) => x === 0)")
    shown = "Object.values(coframe.displays).find((one) => one.topic === '/scan')?.messages?.[0]"
    first = lab.until(f"{shown}?.sequence")
    lab.until(f"first => {shown}?.sequence > first + 20", first)
    replay = open_page(lab.save_replay(tmp_path / "replay.html", 2), offline=True).drawn()
    assert replay.evaluate("coframe.fixed") == "odom"
    assert set(replay.evaluate("coframe.displays")) == set(lab.evaluate("coframe.displays"))
    sequences = set()
    for part in (0.98, 0.6, 0.9):
        replay.scrub(part)
        replay.settle()
        scan = replay.until(shown)
        assert_on_the_walls(scan)
        sequences.add(scan["sequence"])
    assert len(sequences) == 3
    replay.raw.select_option("#fixed", "lidar_link")
    replay.until("coframe.frames.lidar_link.position.every((x) => x === 0)")
    # A scan is at most 0.1 s old. The robot moves a few centimeters in this time.
    assert np.abs(replay.until(shown)["position"]).max() < 0.2
    replay.key("t")
    rows = "document.querySelector('#timeline .sparklines canvas').height"
    replay.until(f"{rows} > 18 * 3")  # one row per moving frame


def rotation(quaternion):
    return coframe.Transform([0.0, 0.0, 0.0], quaternion).matrix[:3, :3]


TETRAHEDRON = np.array([[0, 0, 0], [0.3, 0, 0], [0, 0.3, 0], [0, 0, 0.3]], float)
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def write_stl(path):
    rows = [struct.pack("<12fH", 0, 0, 0, *TETRAHEDRON[list(face)].ravel(), 0) for face in FACES]
    path.write_bytes(b"\0" * 80 + struct.pack("<I", len(FACES)) + b"".join(rows))


def write_obj(path):
    lines = [f"v {x} {y} {z}" for x, y, z in TETRAHEDRON] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in FACES]
    path.write_text("\n".join(["mtllib boom.mtl", "usemtl skin", *lines]))


def write_dae(path):
    """Write a COLLADA file with a texture in the same folder, and the transparency that old exporters write."""
    corners = " ".join(f"{value}" for value in TETRAHEDRON.ravel())
    indices = " ".join(f"{corner} 0" for face in FACES for corner in face)
    path.write_text(f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
  <library_images><image id="i"><init_from>skin.png</init_from></image></library_images>
  <library_effects><effect id="e"><profile_COMMON>
    <newparam sid="su"><surface type="2D"><init_from>i</init_from></surface></newparam>
    <newparam sid="sa"><sampler2D><source>su</source></sampler2D></newparam>
    <technique sid="t"><lambert><diffuse><texture texture="sa" texcoord="UV"/></diffuse>
      <transparent><color>1 1 1 1</color></transparent><transparency><float>0</float></transparency>
    </lambert></technique>
  </profile_COMMON></effect></library_effects>
  <library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="pa" count="12">{corners}</float_array><technique_common>
      <accessor source="#pa" count="4" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
      </accessor></technique_common></source>
    <source id="u"><float_array id="ua" count="2">0 0</float_array><technique_common>
      <accessor source="#ua" count="1" stride="2"><param name="S" type="float"/><param name="T" type="float"/>
      </accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles material="mat" count="4"><input semantic="VERTEX" source="#v" offset="0"/>
      <input semantic="TEXCOORD" source="#u" offset="1" set="0"/><p>{indices}</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"><bind_material><technique_common>
    <instance_material symbol="mat" target="#m"><bind_vertex_input semantic="UV" input_semantic="TEXCOORD"/>
    </instance_material></technique_common></bind_material></instance_geometry></node></visual_scene>
  </library_visual_scenes><scene><instance_visual_scene url="#s"/></scene>
</COLLADA>""")


PIXEL = bytes.fromhex(
    "89504e470d0a1a0a0000000d4948445200000001000000010802000000907753de"
    "0000000c49444154789c63f8cfc000000301010018dd8db00000000049454e44ae426082"
)

URDF = """<robot name="crane">
  <link name="post"><visual><geometry><mesh filename="package://crane/meshes/post.stl"/></geometry></visual></link>
  <link name="boom"><visual><geometry><mesh filename="meshes/boom.obj"/></geometry></visual></link>
  <link name="hook"><visual><geometry><mesh filename="package://crane/meshes/hook.dae"/></geometry></visual></link>
  <link name="load"><visual><geometry><box size="0.1 0.1 0.1"/></geometry>
    <material name="wood"><texture filename="package://crane/meshes/skin.png"/></material></visual></link>
  <joint name="turn" type="revolute"><parent link="post"/><child link="boom"/>
    <origin xyz="0 0 1" rpy="0 0 0.3"/><axis xyz="0 0 1"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="lift" type="prismatic"><parent link="boom"/><child link="hook"/>
    <origin xyz="0.5 0 0" rpy="0 0.2 0"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="0" effort="1" velocity="1"/></joint>
  <joint name="swing" type="continuous"><parent link="hook"/><child link="load"/><axis xyz="1 0 0"/>
    <origin xyz="0 0 -0.2"/></joint>
  <link name="claw"><visual><geometry><capsule radius="0.02" length="0.1"/></geometry></visual>
    <collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="grip" type="prismatic"><parent link="load"/><child link="claw"/><axis xyz="0 1 0"/>
    <origin xyz="0 0 -0.1" rpy="0 0.4 0"/><mimic joint="lift" multiplier="-0.5" offset="0.1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>"""


@pytest.fixture
def crane(tmp_path):
    """Write a ROS package with a robot: an STL mesh, an OBJ and a DAE mesh with textures, and a textured box."""
    package = tmp_path / "crane"
    (package / "meshes").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>crane</name></package>")
    write_stl(package / "meshes" / "post.stl")
    write_obj(package / "meshes" / "boom.obj")
    (package / "meshes" / "boom.mtl").write_text("newmtl skin\nmap_Kd skin.png\n")
    write_dae(package / "meshes" / "hook.dae")
    (package / "meshes" / "skin.png").write_bytes(PIXEL)
    file = package / "crane.urdf"
    file.write_text(URDF)
    return file


def slide(page, joint, value):
    """Move a slider as with the mouse."""
    page.raw.locator(f"#body-joints .joint[data-joint={joint}] input[type=range]").evaluate(
        "(range, value) => { range.value = value; range.dispatchEvent(new Event('input', {bubbles: true})); }", value
    )


ROBOT = "Object.values(coframe.displays).find((one) => one.class === 'RobotModel' && one.robot)"


def assert_link_poses(page, robot, positions):
    """Assert that links are drawn at the poses of coframe's kinematics, which the page does not use."""
    expected = robot.frames(positions)
    deadline = time.monotonic() + 5.0
    while True:
        links = page.evaluate(f"{ROBOT}.links")
        try:
            for name, transform in expected.items():
                np.testing.assert_allclose(links[name][:3], transform.translation, atol=1e-5, err_msg=name)
                assert abs(np.dot(links[name][3:], transform.quaternion)) == pytest.approx(1.0, abs=1e-5), name
        except AssertionError:
            if time.monotonic() > deadline:
                raise
            page.raw.wait_for_timeout(50)
        else:
            return


def test_a_robot_from_a_file_is_drawn_with_its_meshes_and_moved_by_sliders(crane, view, open_page):
    buffer = coframe.Buffer(None)
    buffer.set("map", "post", coframe.Transform(), static=True)
    with (crane.parent / "meshes/boom.mtl").open("a") as materials:
        materials.write("map_bump bumps.tif\n")
    page = open_page(view(buffer, robot=crane, fixed="map").url, expected_errors=["404"]).drawn()
    page.until(f"{ROBOT}?.visible && {ROBOT}.loading === 0 && {ROBOT}.state === 'ok'")
    page.until(f"{ROBOT}.textures === 3")
    assert page.evaluate(f"{ROBOT}.meshes") == 5
    assert page.evaluate(f"{ROBOT}.opacity") == 1, "RViz draws all COLLADA materials opaque"
    robot = coframe.robots.load(crane)
    assert_link_poses(page, robot, {})
    page.tab("joints")
    positions = {"turn": 1.25, "lift": -0.4, "swing": -2.5}
    for joint, value in positions.items():
        slide(page, joint, value)
    assert_link_poses(page, robot, positions)
    page.tab("displays")
    page.wait(
        lambda: "browsers cannot show 1 texture: bumps.tif" in page.text(".card[data-display=RobotModel] small"),
        "the texture that is not drawn",
    )
    page.raw.click("#body-displays .card:has-text('RobotModel') .card-title")
    page.raw.check("#body-displays .card:has-text('RobotModel') label:has-text('Collision Enabled') input")
    page.until(f"{ROBOT}.meshes === 6 && {ROBOT}.loading === 0")
    assert_link_poses(page, robot, positions)
    page.tab("joints")
    assert "Publishing requires a live ROS graph" in page.text("#body-joints")


def test_joint_states_are_published_only_if_enabled(crane, domain_id, view, open_page):
    pytest.importorskip("dds_library", reason="joint states are published over DDS")
    received = []
    with coframe.connect("browser_joints", domain=domain_id) as ros:
        ros.buffer.set("map", "post", coframe.Transform(), static=True)
        ros.subscribe("/joint_states", find("sensor_msgs/msg/JointState"), received.append)
        page = open_page(view(ros, robot=crane).url).drawn()
        page.until(f"{ROBOT}?.visible")
        page.tab("joints")
        slide(page, "turn", 0.5)
        page.raw.wait_for_timeout(500)
        assert not received
        page.raw.check("#body-joints label:has-text('Publish') input")
        slide(page, "turn", -0.75)
        page.wait(
            lambda: received and dict(zip(received[-1].name, received[-1].position, strict=True))["turn"] == -0.75
        )
        assert set(received[-1].name) == {"turn", "lift", "swing", "grip"}
        page.raw.uncheck("#body-joints label:has-text('Publish') input")
        page.raw.wait_for_timeout(400)
        count = len(received)
        page.raw.wait_for_timeout(400)
        assert len(received) == count
