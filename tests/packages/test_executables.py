# SPDX-License-Identifier: Apache-2.0
"""Packages and their executables: declared in sources, installed, and built in; and ``coframe run``."""

import os
import signal
import subprocess
import sys
import time

import pytest

from coframe.errors import PackageError
from coframe.workspace.packages import _console_scripts as console_scripts
from coframe.workspace.packages.executables import executables, find_executable
from coframe.workspace.packages.finding import find_package, source_folders, use_sources_near
from std_msgs.msg import String

PROGRAM = """
import sys
from helpers_pkg import greet

def main():
    print(greet(), sys.argv[1:], sys.argv[0].endswith("talker.py"))
    return 3
"""


def write(path, text=""):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    """A workspace that was never built, with a Python package that imports another one, and one for CMake."""
    source = tmp_path / "ws" / "src"
    for name in ("demo_pkg", "helpers_pkg", "cmake_pkg"):
        write(source / "group" / name / "package.xml", f"<package><name>{name}</name></package>")
    write(
        source / "group/demo_pkg/setup.py",
        "from setuptools import setup\nraise SystemExit('setup.py must not run')\npackage_name = 'demo_pkg'\n"
        "setup(name=package_name, entry_points={'console_scripts': ['talker = demo_pkg.talker:main',\n"
        "  f'listener = {package_name}.listener:main', 'third = ' + package_name + '.third:main']})",
    )
    write(source / "group/demo_pkg/demo_pkg/__init__.py")
    write(source / "group/demo_pkg/demo_pkg/talker.py", PROGRAM)
    write(source / "group/helpers_pkg/setup.py")
    write(source / "group/helpers_pkg/helpers_pkg/__init__.py", "def greet(): return 'hello'")
    write(source / "group/cmake_pkg/scripts/node.py", "print('from cmake')")
    write(
        source / "group/cmake_pkg/CMakeLists.txt",
        "# install(PROGRAMS scripts/old.py DESTINATION lib/x)\n"
        "install(PROGRAMS\n  scripts/node.py  # the node\n  DESTINATION lib/${PROJECT_NAME})\n",
    )
    for variable in ("AMENT_PREFIX_PATH", "COFRAME_PACKAGE_PATH", "ROS_PACKAGE_PATH"):
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.chdir(tmp_path / "ws")
    return tmp_path / "ws"


def run(*arguments, **options):
    command = [sys.executable, "-m", "coframe.cli", "run", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, **options)


def test_a_console_script_of_a_source_folder_runs_with_its_neighbors_on_the_path(workspace):
    result = run("demo_pkg", "talker", "--ros-args", "-r", "a:=b", "--help", cwd=workspace)
    assert result.stdout == "hello ['--ros-args', '-r', 'a:=b', '--help'] True\n"
    assert result.returncode == 3
    assert run("demo_pkg", cwd=workspace / "src" / "group").stdout == "listener\ntalker\nthird\n"
    assert run("cmake_pkg", "node.py", cwd=workspace / "src/group/demo_pkg").stdout == "from cmake\n"


def test_an_unknown_name_is_one_sentence_with_suggestions(workspace):
    result = run("demo_pgk", "talker", cwd=workspace)
    assert result.returncode == 1
    assert "No package named 'demo_pgk'." in result.stderr
    assert "Did you mean 'demo_pkg'? Packages: cmake_pkg, demo_pkg, helpers_pkg." in result.stderr
    result = run("demo_pkg", "talkr", cwd=workspace)
    assert "No executable 'talkr' in the package 'demo_pkg'." in result.stderr
    assert "Did you mean 'talker'? Its executables: listener, talker, third." in result.stderr
    result = run("helpers_pkg", "x", cwd=workspace)
    assert "declares none. coframe reads console_scripts of setup.py" in result.stderr


def test_an_installed_package_comes_before_its_source_and_the_source_before_a_built_in_one(workspace, monkeypatch):
    program = workspace / "install" / "lib" / "demo_pkg" / "talker"
    write(program, "#!/bin/sh\n")
    program.chmod(0o755)
    write(workspace / "install" / "share" / "demo_pkg" / "package.xml")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(workspace / "install"))
    assert find_executable("demo_pkg", "talker").command == (str(program),)
    assert find_executable("demo_pkg", "listener").command[-1] == "demo_pkg.listener:main"
    assert find_package("demo_pkg").share == workspace / "install" / "share" / "demo_pkg"


def test_sources_near_a_file_are_found_from_anywhere(workspace, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(PackageError):
        find_package("demo_pkg")
    monkeypatch.setenv("COFRAME_PACKAGE_PATH", "")
    use_sources_near(workspace / "src" / "group" / "demo_pkg" / "launch")
    assert os.environ["COFRAME_PACKAGE_PATH"] == str(workspace / "src")
    assert find_package("helpers_pkg").origin == "source"
    assert source_folders(tmp_path) == []
    alone = tmp_path / "alone"
    write(alone / "package.xml", "<package><name>alone</name></package>")
    assert source_folders(alone / "launch") == [tmp_path]


def test_built_in_executables():
    found = executables("tf2_ros")
    assert found["tf2_echo"].command[2:] == ("coframe.workspace.entry_point", "coframe.cli:main", "echo")
    result = run("robot_state_publisher", "robot_state_publisher", "/no/such.urdf")
    assert "robot_state_publisher: /no/such.urdf: cannot be read: No such file or directory" in result.stderr
    assert find_executable("rviz2", "rviz2").command[-2:] == ("coframe.cli:main", "view")


@pytest.mark.parametrize(
    ("name", "text", "scripts", "root"),
    [
        ("setup.cfg", "[options.entry_points]\nconsole_scripts =\n  a = p.m:main\n  b=p.n:Class.run\n", "ab", "."),
        (
            "setup.cfg",
            "[options]\npackage_dir =\n  = src\n[options.entry_points]\nconsole_scripts = a=p:m\n",
            "a",
            "src",
        ),
        ("pyproject.toml", '[project.scripts]\na = \'p.m:main\'\n"b" = "p.m:other"\n[tool]\nx = 1', "ab", "."),
        ("pyproject.toml", "[tool.poetry.scripts]\na = 'p.m:main'", "a", "."),
        ("setup.py", "setup(entry_points='[console_scripts]\\na = p:m\\n', package_dir={'': 'lib'})", "a", "lib"),
        ("setup.py", "import x\nSCRIPTS = ['a = p:m']\nx.setup(entry_points=dict(a=1))", "", "."),
        ("setup.py", "E = {'console_scripts': ['a = p:m', 'b = ' + unknown(), 5]}\nsetup(entry_points=E)", "a", "."),
        ("setup.py", "def broken(:", "", "."),
        ("setup.cfg", "no section", "", "."),
        ("pyproject.toml", "[project", "", "."),
    ],
)
def test_declarations_of_console_scripts(tmp_path, name, text, scripts, root):
    write(tmp_path / name, text)
    found = console_scripts.read(tmp_path)
    assert "".join(sorted(found.scripts)) == scripts
    assert found.root == root


@pytest.mark.parametrize("module", ["demo_nodes_py.talker", "demo_nodes_py.listener", "turtlesim.turtlesim_node"])
def test_a_damaged_parameter_file_is_one_sentence(module, tmp_path):
    write(tmp_path / "bad.yaml", "talker: [1")
    command = [sys.executable, "-m", module, "--ros-args", "--params-file", str(tmp_path / "bad.yaml")]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert ended.returncode == 1
    assert "Couldn't parse params file" in ended.stderr
    assert "Traceback" not in ended.stderr


def test_the_listener_escapes_what_it_received(make_node):
    node = make_node("talker")
    publisher = node.create_publisher(String, "chatter", 10)
    command = [sys.executable, "-u", "-m", "demo_nodes_py.listener"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as listener:
        while not publisher.get_subscription_count():
            time.sleep(0.01)
        publisher.publish(String(data="\x1b[2Jhello"))
        received = listener.stderr.readline()
        listener.send_signal(signal.SIGINT)
    assert "hello" in received
    assert "\x1b" not in received


HOSTILE_FILES = {
    "setup.py": "a = 'x' * 9\na = 'xxxxxxxx'\n" + "a = a + a\n" * 60 + "setup(scripts=[a])",
    "setup.cfg": "[options]\nscripts =\n" + " x\n" * 80_000,
    "pyproject.toml": "a." * 120_000 + "a = 1",
    "CMakeLists.txt": "install(PROGRAMS " * 15_000 + "install( PROGRAMS" + " " * 5000,
}


@pytest.mark.parametrize("name", HOSTILE_FILES)
def test_a_hostile_package_takes_little_time(workspace, name):
    write(workspace / "src/group/helpers_pkg" / name, HOSTILE_FILES[name])
    started = time.monotonic()
    executables("helpers_pkg")
    assert time.monotonic() - started < 5


def test_a_text_that_doubles_is_not_a_name(workspace):
    doubling = "a = f'{a}{a}'\n" * 60
    write(workspace / "src/group/helpers_pkg/setup.py", f"a = 'xxxxxxxx'\n{doubling}setup(scripts=[a, 'scripts/b'])")
    write(workspace / "src/group/helpers_pkg/scripts/b", "#!/usr/bin/env python3\n")
    assert list(executables("helpers_pkg")) == ["b"]
