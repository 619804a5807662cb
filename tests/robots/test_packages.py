# SPDX-License-Identifier: Apache-2.0
"""The search for packages and their files, with and without ROS."""

import os

import pytest

from coframe.robots import PackageError, Packages, RobotDescriptionError, files, load

PATHS = ("COFRAME_PACKAGE_PATH", "AMENT_PREFIX_PATH", "ROS_PACKAGE_PATH")


@pytest.fixture(autouse=True)
def no_ros(monkeypatch):
    for variable in PATHS:
        monkeypatch.delenv(variable, raising=False)


def make_package(folder, name=None):
    (folder / "meshes").mkdir(parents=True)
    (folder / "meshes" / "hand.stl").write_text("solid")
    (folder / "package.xml").write_text(f"<package><name>{name or folder.name}</name></package>")
    return folder


def test_packages_are_found_in_all_search_paths(tmp_path, monkeypatch):
    own = make_package(tmp_path / "ws" / "src" / "own")
    make_package(tmp_path / "ws" / "src" / "neighbor")
    make_package(tmp_path / "listed" / "deep" / "folder_of_another_name", "by_manifest")
    make_package(tmp_path / "prefix" / "share" / "installed")
    make_package(tmp_path / "old" / "noetic")
    (tmp_path / "listed" / "plain").mkdir()
    monkeypatch.setenv("COFRAME_PACKAGE_PATH", os.pathsep.join([str(tmp_path / "listed"), str(tmp_path / "gone")]))
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "prefix"))
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "old"))
    packages = Packages(own / "urdf" / "robot.urdf")
    for name in ("own", "neighbor", "by_manifest", "plain", "installed", "noetic"):
        assert packages.find(name).is_dir(), name
    assert packages.resolve("package://by_manifest/meshes/hand.stl").read_text() == "solid"
    renamed = make_package(tmp_path / "share" / "folder-name", "manifest_name")
    assert Packages(renamed / "urdf" / "robot.urdf").find("folder-name") == renamed
    (own / "urdf").mkdir()
    assert packages.resolve("../meshes/hand.stl").is_file()
    with pytest.raises(PackageError, match="no package named 'folder_of_another'") as caught:
        packages.find("folder_of_another")
    assert "COFRAME_PACKAGE_PATH" in caught.value.hint


@pytest.mark.parametrize(
    "url",
    [
        "package://own/../secret",
        "package://own/meshes/../../secret",
        "package://own/%2e%2e/secret",
        "package://own//etc/hostname",
        "package://own/link_out",
        "package://own/link_up/secret",
        "package://../own/meshes/hand.stl",
        "package://./own/meshes/hand.stl",
        "package:///etc/hostname",
        "package://own/loop",
        "package://own/\0",
        "package://own/" + "a" * 5000,
        "package://own",
        "package://own/meshes",
        "file:///etc/hostname",
        "http://example.org/x.stl",
        "../../secret",
        "/etc/hostname",
    ],
)
def test_files_outside_a_package_are_not_resolved(tmp_path, url):
    own = make_package(tmp_path / "own")
    (tmp_path / "secret").write_text("secret")
    (own / "link_out").symlink_to(tmp_path / "secret")
    (own / "link_up").symlink_to(tmp_path)
    (own / "loop").symlink_to(own / "loop")
    (own / "link_inside").symlink_to(own / "meshes" / "hand.stl")
    packages = Packages(own / "meshes" / "robot.urdf")
    assert packages.resolve("package://own/link_inside").name == "hand.stl"
    assert packages.resolve("hand.stl").name == "hand.stl"
    with pytest.raises(PackageError):
        packages.resolve(url)


XACRO = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="tool" default="hand"/>
  <xacro:include filename="$(find parts)/parts.xacro"/>
  <link name="base"/>
  <xacro:limb name="$(arg tool)" length="${0.25 * 2}"/>
</robot>"""
PARTS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="limb" params="name length">
    <link name="${name}"/>
    <joint name="${name}_joint" type="fixed">
      <parent link="base"/><child link="${name}"/><origin xyz="${length} 0 0"/>
    </joint>
  </xacro:macro>
</robot>"""


def test_xacro_is_expanded_and_finds_packages_without_ros(tmp_path, monkeypatch):
    pytest.importorskip("xacro")
    (tmp_path / "somewhere" / "parts").mkdir(parents=True)
    (tmp_path / "somewhere" / "parts" / "parts.xacro").write_text(PARTS)
    (tmp_path / "arm.urdf.xacro").write_text(XACRO)
    with pytest.raises(RobotDescriptionError, match=r"arm.urdf.xacro: xacro: no package named 'parts'\nHint: Add the"):
        load(tmp_path / "arm.urdf.xacro")
    monkeypatch.setenv("COFRAME_PACKAGE_PATH", str(tmp_path / "somewhere"))
    robot = load(tmp_path / "arm.urdf.xacro", arguments={"tool": "gripper"})
    assert robot.path == tmp_path / "arm.urdf.xacro"
    assert robot.frames()["gripper"].translation.tolist() == [0.5, 0, 0]


@pytest.mark.parametrize(
    "body",
    [
        "<link name=\"${'x' * 10**10}\"/>",
        '<link name="${9**9**9}"/>',
        '<xacro:macro name="m30"><link name="a"/></xacro:macro>'
        + "".join(
            f'<xacro:macro name="m{i}"><xacro:m{i + 1}/><xacro:m{i + 1}/></xacro:macro>' for i in reversed(range(30))
        )
        + "<xacro:m0/>",
    ],
)
def test_a_xacro_file_cannot_exhaust_memory_or_time(tmp_path, monkeypatch, body):
    pytest.importorskip("xacro")
    monkeypatch.setattr(files, "MAX_SECONDS", 2.0)
    (tmp_path / "a.urdf.xacro").write_text(
        f'<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">{body}</robot>'
    )
    with pytest.raises(RobotDescriptionError, match="the maximum"):
        load(tmp_path / "a.urdf.xacro")


@pytest.mark.parametrize(
    "body",
    [
        '<xacro:include filename="a.urdf.xacro"/>',
        '<xacro:macro name="m"><xacro:m/></xacro:macro><xacro:m/>',
        "<a>" * 3000 + "</a>" * 3000,
    ],
)
def test_xacro_that_is_nested_too_deeply_is_an_error_with_a_hint(tmp_path, body):
    pytest.importorskip("xacro")
    (tmp_path / "a.urdf.xacro").write_text(
        f'<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">{body}</robot>'
    )
    with pytest.raises(RobotDescriptionError, match="nested too deeply to be expanded") as caught:
        load(tmp_path / "a.urdf.xacro")
    assert "a macro or an included file contains itself" in caught.value.hint


def test_load_errors_contain_the_file_and_the_line(tmp_path):
    with pytest.raises(RobotDescriptionError, match=r"gone.urdf: cannot be read: No such file"):
        load(tmp_path / "gone.urdf")
    (tmp_path / "bad.urdf").write_text("<robot name='r'>\n<link/></robot>")
    with pytest.raises(RobotDescriptionError, match=r"bad.urdf, line 2: <link> needs the attribute name"):
        load(tmp_path / "bad.urdf")
