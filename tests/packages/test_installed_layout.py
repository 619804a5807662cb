# SPDX-License-Identifier: Apache-2.0
"""Source folders of packages look as they would after their installation."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from coframe.workspace.packages.executables import module_folders
from coframe.workspace.packages.finding import find_package

pytestmark = pytest.mark.skipif(os.name != "posix", reason="the folders consist of links")


@pytest.fixture
def package(tmp_path, monkeypatch):
    """Return a function that writes the files of a package and returns its share folder."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("COFRAME_PACKAGE_PATH", str(tmp_path / "src"))

    def write(name, files):
        for path, text in {"package.xml": f"<package><name>{name}</name></package>", **files}.items():
            file = tmp_path / "src" / name / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        return find_package(name).share

    return write


def test_folders_and_files_that_cmake_installs_elsewhere(package):
    share = package(
        "arm_one",
        {
            "CMakeLists.txt": "project(arm_one)\n"
            "install(DIRECTORY description/urdf bringup/launch DESTINATION share/${PROJECT_NAME})\n"
            'install(FILES extra/one.yaml "extra/two.yaml" DESTINATION share/arm_one/config) # a comment\n'
            "install(DIRECTORY meshes/ DESTINATION share/${PROJECT_NAME}/parts PATTERN x EXCLUDE)\n"
            "install(TARGETS node DESTINATION lib/${PROJECT_NAME})\n"
            "install(DIRECTORY ../../.. DESTINATION share/arm_one/outside)\n",
            "description/urdf/arm.urdf": "<robot/>",
            "bringup/launch/go.launch.py": "",
            "extra/one.yaml": "1",
            "extra/two.yaml": "2",
            "config/three.yaml": "3",
            "meshes/a.stl": "a",
        },
    )
    assert (share / "urdf/arm.urdf").read_text() == "<robot/>"
    assert (share / "launch/go.launch.py").is_file()
    assert sorted(each.name for each in (share / "config").iterdir()) == ["one.yaml", "three.yaml", "two.yaml"]
    assert (share / "parts/a.stl").read_text() == "a"
    assert not (share / "outside").exists()
    assert (share / "description/urdf/arm.urdf").is_file(), "the source folders are there too"
    assert find_package("arm_one").share == share


def test_data_files_of_setup_py(package):
    share = package(
        "legs",
        {
            "setup.py": "import os\nfrom glob import glob\nfrom setuptools import setup\npackage_name = 'legs'\n"
            "setup(name=package_name, data_files=[('share/' + package_name, ['package.xml']),\n"
            "  (os.path.join('share', package_name, 'config'), glob(os.path.join('data', '*.yaml'))),\n"
            "  (f'share/{package_name}/launch', glob('starts/*.launch.py') + ['more/b.launch.py'])])\n",
            "data/gait.yaml": "trot",
            "starts/a.launch.py": "",
            "more/b.launch.py": "",
        },
    )
    assert (share / "config/gait.yaml").read_text() == "trot"
    assert sorted(each.name for each in (share / "launch").iterdir()) == ["a.launch.py", "b.launch.py"]
    assert (share / "package.xml").is_file()


def test_a_package_that_installs_its_folders_as_they_are_is_its_own_share_folder(package, tmp_path):
    share = package(
        "base",
        {"CMakeLists.txt": "install(DIRECTORY urdf DESTINATION share/${PROJECT_NAME})", "urdf/base.urdf": "<robot/>"},
    )
    assert share == tmp_path / "src/base"
    assert not (tmp_path / "cache").exists()


def test_launch_files_import_the_modules_of_the_workspace(package, tmp_path):
    package(
        "helpers",
        {"helpers/__init__.py": "GREETING = 'hello from helpers'", "CMakeLists.txt": "project(helpers)"},
    )
    package(
        "bringup",
        {
            "CMakeLists.txt": "project(bringup)\ninstall(DIRECTORY files/launch DESTINATION share/${PROJECT_NAME})",
            "files/launch/go.launch.py": "from helpers import GREETING\nfrom launch import LaunchDescription\n"
            "from launch.actions import LogInfo, ExecuteProcess\n"
            "from launch.substitutions import EnvironmentVariable\n"
            "def generate_launch_description():\n"
            "    return LaunchDescription([LogInfo(msg=[GREETING, ' on ', EnvironmentVariable('ROS_DISTRO')])])\n",
        },
    )
    package("tf2_ros", {"tf2_ros/__init__.py": "raise RuntimeError('not this one')"})
    environment = {name: value for name, value in os.environ.items() if name not in {"ROS_DISTRO", "COFRAME_DISTRO"}}
    done = subprocess.run(
        [sys.executable, "-m", "coframe.cli", "launch", "bringup", "go.launch.py"],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
        cwd=tmp_path,
        env={**environment, "ROS_LOG_DIR": str(tmp_path / "log")},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "hello from helpers on jazzy" in done.stdout
    assert [Path(each).name for each in module_folders()] == ["helpers"]


def test_a_failing_command_begins_with_its_last_line():
    from launch import LaunchContext
    from launch.substitutions import Command, SubstitutionFailure

    program = "import sys; print('a\\nthe file is missing', file=sys.stderr); sys.exit(1)"
    with pytest.raises(SubstitutionFailure, match=r"^the file is missing: executed command failed. Command: "):
        Command([sys.executable, f' -c "{program}"']).perform(LaunchContext())


def test_package_urls_follow_the_installation(package, tmp_path):
    from coframe.robots import load

    package(
        "arm_two",
        {
            "CMakeLists.txt": "project(arm_two)\ninstall(DIRECTORY description/urdf DESTINATION share/${PROJECT_NAME})",
            "description/urdf/part.xacro": '<robot xmlns:xacro="http://ros.org/xacro"><link name="inner"/></robot>',
            "description/urdf/arm.urdf.xacro": '<robot name="arm" xmlns:xacro="http://ros.org/xacro">'
            '<xacro:include filename="$(find arm_two)/urdf/part.xacro"/></robot>',
        },
    )
    assert load(tmp_path / "src/arm_two/description/urdf/arm.urdf.xacro").root == "inner"


@pytest.mark.parametrize(
    "setup",
    [
        "import os\na = 'abcdefgh'\n" + "a = os.path.join(a, a)\n" * 30,
        "x = {[1]: 1}\n",
        "x = f'{0x" + "f" * 6000 + "}'\n",
        "x = ['a' + 'b'] + " + "(" * 50 + "[]" + ")" * 50 + "\n",
        "files = [('share/{name}/x', glob('') + glob('.') + glob('[') + glob('a**/x'))]\n",
        "files = [('share/{name}/x', glob('" + "**/" * 20 + "*'))]\n",
        "files = [('share/{name}/x\\0y', ['here']), ('share/{name}/x', ['he\\0re'])]\n",
        "files = [('share/{name}/\\ud800', ['here'])]\n",
        "files = [('share/{name}/" + "deep/" * 3000 + "', ['here'])]\n",
        "files = ['a']\n" + "files.extend(files)\n" * 40 + "files.append(files)\n",
        "files = [('share/{name}/x', [])]\n" + "x = glob('**/*')\n" * 10_000,
    ],
    ids=[
        "joined",
        "key",
        "number",
        "parentheses",
        "patterns",
        "folders",
        "nul",
        "surrogate",
        "depth",
        "extended",
        "searches",
    ],
)
def test_a_hostile_setup_py_changes_nothing(package, setup, request):
    """Other packages of a workspace are found although one has a setup.py that never ran."""
    name = f"arm_{request.node.callspec.id}"
    written = setup.replace("{name}", name) + "setup(data_files=files)\n"
    nested = {f"{first}/{second}/{third}/file": "" for first in "abcd" for second in "abcd" for third in "abcd"}
    started = time.monotonic()
    share = package(name, {"setup.py": written, "here": "1", **nested})
    assert (share / "here").read_text() == "1"
    assert time.monotonic() - started < 10.0


def test_variables_patterns_and_new_names_of_cmake(package):
    share = package(
        "arm_nine",
        {
            "CMakeLists.txt": "set(target share/arm_nine)\nfile(GLOB files models/*.sdf)\n"
            "install(FILES ${files} DESTINATION ${target}/worlds)\n"
            "install(FILES robot.yaml DESTINATION ${target}/config RENAME arm.yaml)\n",
            "models/a.sdf": "a",
            "models/b.txt": "b",
            "robot.yaml": "r",
        },
    )
    assert [each.name for each in (share / "worlds").iterdir()] == ["a.sdf"]
    assert (share / "config/arm.yaml").read_text() == "r"


def test_a_list_of_data_files_that_grows(package):
    share = package(
        "arm_ten",
        {
            "setup.py": "data_files = []\ndata_files.append(('share/arm_ten/launch', ['go.launch.py']))\n"
            "data_files.extend([('share/arm_ten/worlds', ['models/a.sdf'])])\nsetup(data_files=data_files)\n",
            "go.launch.py": "go",
            "models/a.sdf": "a",
        },
    )
    assert (share / "launch/go.launch.py").read_text() == "go"
    assert (share / "worlds/a.sdf").read_text() == "a"


def test_variables_of_cmake_that_double(package):
    started = time.monotonic()
    doubled = "set(a ${a}${a})\n" * 60 + "set(a ${a};${a})\n" * 60
    share = package("arm_eleven", {"CMakeLists.txt": "set(a abcdefgh)\n" + doubled, "here": "1"})
    assert (share / "here").read_text() == "1"
    assert time.monotonic() - started < 5.0


def test_a_hostile_cmake_file_changes_nothing(package):
    files = "${PROJECT_NAME} " * 8000
    share = package(
        "arm_seven",
        {
            "CMakeLists.txt": f"project({'A' * 120_000})\ninstall(FILES {files} DESTINATION share/x/y)\n"
            "install(FILES here DESTINATION share/arm_seven/x\0y)\n"
            f"install(FILES here DESTINATION share/arm_seven/{'d' * 300})\n",
            "here": "1",
        },
    )
    assert (share / "here").read_text() == "1"


def test_many_rules_for_a_folder_that_the_sources_have_too(package):
    files = {f"{folder}/{number}": "" for folder in ("data", "meshes") for number in range(1500)}
    started = time.monotonic()
    share = package(
        "arm_eight", {"CMakeLists.txt": "install(DIRECTORY data/ DESTINATION share/arm_eight/meshes)", **files}
    )
    assert (share / "meshes/7").resolve().parent.name == "data"
    assert time.monotonic() - started < 10.0


def test_loops_and_lists_of_cmake(package):
    share = package(
        "arm_twelve",
        {
            "CMakeLists.txt": "set(folders urdf)\nlist(APPEND folders meshes)\n"
            "foreach(folder ${folders})\n"
            "  install(DIRECTORY src/${folder}/ DESTINATION share/arm_twelve/${folder})\nendforeach()\n"
            "foreach(side IN LISTS sides ITEMS left right)\n  foreach(kind a b)\n"
            "    install(FILES ${kind}.yaml DESTINATION share/arm_twelve/config/${side})\n"
            "  endforeach()\nendforeach(side)\n"
            "install(FILES ${side}.yaml DESTINATION share/arm_twelve/config)\n",
            **{name: name for name in ("src/urdf/arm.urdf", "src/meshes/arm.stl", "a.yaml", "b.yaml")},
        },
    )
    assert (share / "urdf/arm.urdf").read_text() == "src/urdf/arm.urdf"
    assert (share / "meshes/arm.stl").is_file()
    assert [each.name for each in sorted((share / "config").iterdir())] == ["left", "right"]
    assert [each.name for each in sorted((share / "config/right").iterdir())] == ["a.yaml", "b.yaml"]


def test_loops_of_cmake_have_limits(package):
    started = time.monotonic()
    nested = "foreach(a 1 2 3 4 5 6 7 8 9)\n" * 5000
    share = package("arm_thirteen", {"CMakeLists.txt": nested + "install(FILES here DESTINATION share/x)", "here": "1"})
    assert (share / "here").read_text() == "1"
    assert time.monotonic() - started < 10.0


def test_the_layout_of_packages_for_navigation_and_control(package):
    """The sources and installations of nav2_bringup and ros2_control_demos are laid out like this."""
    share = package(
        "demo_example_1",
        {
            "CMakeLists.txt": "project(demo_example_1)\nfind_package(ament_cmake REQUIRED)\n"
            "add_library(demo_example_1 SHARED hardware/rrbot.cpp)\n"
            "install(DIRECTORY hardware/include/ DESTINATION include/demo_example_1)\n"
            "install(DIRECTORY description/launch description/ros2_control description/urdf\n"
            "  DESTINATION share/demo_example_1)\n"
            "install(DIRECTORY bringup/launch bringup/config DESTINATION share/${PROJECT_NAME})\n"
            "install(TARGETS demo_example_1 EXPORT export RUNTIME DESTINATION bin)\n"
            "if(BUILD_TESTING)\n  find_package(ament_lint_auto REQUIRED)\nendif()\nament_package()\n",
            "bringup/launch/rrbot.launch.py": "bringup",
            "bringup/config/controllers.yaml": "c",
            "bringup/launch/parts/a.launch.py": "bringup",
            "description/launch/view.launch.py": "description",
            "description/launch/parts/b.launch.py": "description",
            "description/urdf/rrbot.urdf.xacro": "<robot/>",
            "description/ros2_control/rrbot.xacro": "<robot/>",
            "hardware/rrbot.cpp": "",
        },
    )
    assert (share / "urdf/rrbot.urdf.xacro").read_text() == "<robot/>"
    assert (share / "ros2_control/rrbot.xacro").is_file()
    assert sorted(each.name for each in (share / "launch").iterdir()) == ["parts", "rrbot.launch.py", "view.launch.py"]
    assert sorted(each.name for each in (share / "launch/parts").iterdir()) == ["a.launch.py", "b.launch.py"]
    assert (share / "config/controllers.yaml").read_text() == "c"
