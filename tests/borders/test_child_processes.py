# SPDX-License-Identifier: Apache-2.0
"""Every command that starts Python processes, in a folder full of modules that shadow the standard library."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest
from recordings import write_mcap
from strangers import HOSTILE, clean_environment

from coframe.cli.ros2 import installing
from coframe.robots import load as load_robot

ROOT = Path(__file__).parents[2]
COMMAND = Path(sys.executable).parent / "coframe"
# What the interpreter has loaded before any program starts cannot be shadowed; `this` would print a poem.
SHADOWED = sorted(sys.stdlib_module_names - set(sys.builtin_module_names) - {"this", "antigravity"})
PACKAGE = {
    "setup.py": "from setuptools import setup\n"
    "setup(name='greeter', packages=['greeter'], entry_points={'console_scripts': ['greet = greeter.main:main']})\n",
    "package.xml": "<package><name>greeter</name></package>",
    "CMakeLists.txt": "install(PROGRAMS scripts/wave.py DESTINATION lib/${PROJECT_NAME})",
    "greeter/__init__.py": "",
    "greeter/main.py": "import json, types\ndef main():\n    print('hello from', json.__name__)\n",
    "scripts/wave.py": "import json, types\nprint('waving with', json.__name__)\n",
    "launch/greet.launch.xml": '<launch><node pkg="greeter" exec="greet" output="screen"/></launch>',
}
XACRO = (
    '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><link name="${1 + 1}a"/><link name="b"/>'
    '<joint name="j" type="fixed"><parent link="2a"/><child link="b"/></joint></robot>'
)


@pytest.fixture
def shadow(tmp_path, write):
    """A folder with a module of a stranger under each name of the standard library."""
    return write(tmp_path / "shadow", {f"{name}.py": HOSTILE for name in SHADOWED})


@pytest.fixture
def execute(shadow, proof, domain_id, tmp_path):
    def run(*words, command=COMMAND, code=0, **variables):
        environment = clean_environment(
            PROOF_OF_EXECUTION=str(proof),
            ROS_DOMAIN_ID=str(domain_id),
            ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST",
            HOME=str(tmp_path),
            **variables,
        )
        done = subprocess.run(
            [str(command), *map(str, words)],
            cwd=shadow,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
            timeout=100,
        )
        output = done.stdout + done.stderr
        assert not proof.exists(), proof.read_text() + output
        assert "*** imported" not in output
        assert done.returncode == code, output
        return output

    return run


def test_the_modules_would_be_imported(shadow, proof):
    """The test itself: Python imports them if it is started as `python -m`."""
    command = [sys.executable, "-m", "coframe.cli", "--help"]
    done = subprocess.run(command, cwd=shadow, env=clean_environment(PROOF_OF_EXECUTION=str(proof)), check=False)
    assert done.returncode != 0
    assert proof.exists()


def test_packages(execute, tmp_path, write):
    source = write(tmp_path / "ws/src/greeter", PACKAGE).parent
    variables = {"COFRAME_PACKAGE_PATH": str(source)}
    assert "hello from json" in execute("run", "greeter", "greet", **variables)
    assert "waving with json" in execute("run", "greeter", "wave.py", **variables)
    assert "hello from json" in execute("launch", "greeter", "greet.launch.xml", **variables)


@pytest.mark.slow  # the lab starts its nodes in the same way
def test_the_demo(execute):
    output = execute("demo", "--no-browser", "--port", "0", "--duration", "3")
    assert "base_link" in output


@pytest.mark.parametrize("step", ["run", pytest.param("break", marks=pytest.mark.slow), "check"])
def test_the_lab(execute, tmp_path, step):
    folder = tmp_path / "student"
    if step == "break":
        execute("lab", "break", "1", "--duration", "3", "--port", "0")
        return
    execute("lab", "new", folder)
    if step == "run":
        execute("lab", "run", folder, "--no-browser", "--port", "0", "--duration", "3")
    else:
        assert "coframe lab check" in execute("lab", "check", "--help")
        assert "of 15" in execute("lab", "check", folder, "--only", "visualization")


def test_xacro_and_recordings(execute, shadow, proof, tmp_path, write, monkeypatch):
    write(tmp_path, {"robot.urdf.xacro": XACRO})
    with monkeypatch.context() as changed:
        changed.chdir(shadow)
        assert list(load_robot(tmp_path / "robot.urdf.xacro").links) == ["2a", "b"]
    assert not proof.exists()
    bag = write_mcap(tmp_path / "run.mcap")
    assert "60 poses" in execute("batch", "odom", "lidar", bag, "-o", tmp_path / "poses")


def test_the_executables_of_ros2(execute, tmp_path):
    script = tmp_path / "ros2"
    script.write_text(installing._script("ros2"))
    script.chmod(0o755)
    assert "topic" in execute("--help", command=script)


def test_an_empty_element_of_pythonpath_is_not_the_current_folder(shadow, proof, monkeypatch):
    from coframe._process.python_children import python_command, python_environment

    monkeypatch.setenv("PYTHONPATH", f"/nowhere:{Path('relative')}:")
    environment = python_environment()
    assert environment["PYTHONPATH"] == f"/nowhere:{Path('relative').absolute()}"
    done = subprocess.run(
        python_command("coframe.cli", "--help"),
        cwd=shadow,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, proof.exists()) == (0, False), done.stderr


def test_all_python_processes_are_started_by_their_owner():
    """No module starts ``python -m`` or ``python -c``; a file is run with -I, or is the user's own program."""
    found = []
    for path in (ROOT / "src").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            words = [each.value for each in getattr(node, "elts", ()) if isinstance(each, ast.Constant)]
            if (
                isinstance(node, ast.List | ast.Tuple)
                and {"-m", "-c"} & set(words[:2])
                and "executable" in ast.dump(node)
            ):
                found.append(f"{path.relative_to(ROOT)}:{node.lineno}")
    assert found == []
