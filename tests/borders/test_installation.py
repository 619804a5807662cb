# SPDX-License-Identifier: Apache-2.0
"""Programs that do not use coframe do not notice that it is installed."""

import ast
import os
import site
import sys
import time
from pathlib import Path

import pytest
from strangers import HOSTILE

# What a program sees of the import system after it has run.
STATE = """
import sys, runpy
words = {words!r}
if words:
    sys.argv = words
    try:
        runpy.run_module(words[0], run_name="__main__", alter_sys=True)
    except SystemExit:
        pass
kinds = [getattr(finder, "__name__", type(finder).__name__) for finder in sys.meta_path]
print(repr([sorted(sys.modules), sys.path, kinds, len(sys.path_hooks)]))
"""
FAILING = """
for name in ("no_such_package", "simplejson", "org.python.core", "matplotlib_of_nobody.pyplot", "nobody_msgs"):
    try:
        __import__(name)
    except ImportError:
        pass
"""


def state(environment, folder, flags, code):
    done = environment.run(*flags, "-c", code, cwd=folder)
    assert done.returncode == 0, done.stderr
    return ast.literal_eval(done.stdout.splitlines()[-1])


@pytest.mark.parametrize("flags", [[], ["-I"], ["-S"]], ids=["plain", "isolated", "without site"])
@pytest.mark.parametrize("code", ["", FAILING], ids=["nothing", "failing imports"])
def test_the_import_system_differs_by_one_folder(bare, installed, tmp_path, flags, code):
    expected, found = (state(each, tmp_path, flags, code + STATE.format(words=[])) for each in (bare, installed))
    assert_equal(found, expected, bare, installed)


@pytest.mark.parametrize("words", [["pip", "--version"], ["pytest", "--version"]], ids=["pip", "pytest"])
def test_other_commands_do_not_import_coframe(bare, installed, tmp_path, words):
    expected, found = (state(each, tmp_path, [], STATE.format(words=words)) for each in (bare, installed))
    assert_equal(found, expected, bare, installed)


def assert_equal(found, expected, bare, installed):
    added = str(installed.packages / "coframe/ros")
    others = [folder.replace(str(installed.python.parents[1]), str(bare.python.parents[1])) for folder in found[1]]
    assert [folder for folder in others if not folder.endswith("coframe/ros")] == expected[1]
    assert found[1].count(added) == (1 if any("site-packages" in folder for folder in expected[1]) else 0)
    assert [found[0], found[2], found[3]] == [expected[0], expected[2], expected[3]]


def test_a_failing_import_of_the_system_at_every_start_costs_no_import(bare, installed, tmp_path):
    """Debian's and Ubuntu's Python try to import apport_python_hook at every start."""
    hook = "try:\n    import apport_python_hook\nexcept ImportError:\n    pass\n"
    results = []
    for environment in (bare, installed):
        file = environment.packages / "sitecustomize.py"
        file.write_text(hook)
        try:
            results.append(state(environment, tmp_path, [], STATE.format(words=[])))
        finally:
            file.unlink()
    assert "sitecustomize" in results[0][0]
    assert results[0][0] == results[1][0]


def test_the_line_that_python_runs_at_every_start_is_fast(installed, monkeypatch):
    monkeypatch.setattr(sys, "path", [*sys.path])
    monkeypatch.setattr(sys, "path_importer_cache", {**sys.path_importer_cache})
    times = []
    for _ in range(20):
        begin = time.process_time()
        site.addpackage(str(installed.packages), "coframe_ros.pth", set())
        times.append(time.process_time() - begin)
    assert min(times) < 0.0005


def test_the_file_is_short_and_commented(installed):
    comment, folder, line = (installed.packages / "coframe_ros.pth").read_text().splitlines()
    assert comment.startswith("#")
    assert folder == "coframe/ros"
    assert line.startswith("import sys; ")
    assert len(line) < 450  # one statement of one line


def test_files_of_strangers_are_not_executed(installed, proof, write, tmp_path):
    folder = write(
        tmp_path / "downloaded",
        {
            "org/msg/A.msg": "",
            "org/org/python/core.py": HOSTILE,
            "simplejson/msg/A.msg": "",
            "simplejson/simplejson/JSONDecodeError.py": HOSTILE,
            "matplotlib_of_nobody/msg/A.msg": "",
            "matplotlib_of_nobody/matplotlib_of_nobody/pyplot.py": HOSTILE,
            "a/b/deep_msgs/msg/A.msg": "",
            "a/b/deep_msgs/deep_msgs/helpers.py": HOSTILE,
            "a/b/deep_msgs/package.xml": "<package><name>org</name></package>",
            ".git/HEAD": "",
            "docs/index.md": "",
        },
    )
    code = FAILING + "import copy\ntry:\n    import simplejson.JSONDecodeError\nexcept ImportError:\n    pass"
    program = write(tmp_path / "elsewhere", {"program.py": code}) / "program.py"
    for place in (folder, folder / "docs", folder / "a/b"):
        for words in (["-c", code], ["-I", "-c", code], [program], ["-m", "pip", "--version"]):
            done = installed.run(*words, cwd=place, PROOF_OF_EXECUTION=str(proof))
            assert (done.returncode, proof.exists()) == (0, False), done.stderr
    # Where the program asks for its messages, it gets these and no code.
    code = "from deep_msgs.msg import A\nprint(A())\nimport deep_msgs.helpers"
    (folder / "a/b/deep_msgs/package.xml").unlink()
    done = installed.run("-c", code, cwd=folder / "a/b", PROOF_OF_EXECUTION=str(proof))
    assert done.stdout == "deep_msgs.msg.A()\n", done.stderr
    assert "No module named 'deep_msgs.helpers'" in done.stderr
    assert not proof.exists()


def test_pipes_and_many_folders_do_not_delay_failing_imports(installed, tmp_path):
    (tmp_path / "x/msg").mkdir(parents=True)
    (tmp_path / "x/msg/A.msg").touch()
    os.mkfifo(tmp_path / "x/package.xml")
    assert installed.run("-c", FAILING, cwd=tmp_path).stderr == ""


def test_packages_of_the_system_come_before_those_of_coframe(installed, write, tmp_path):
    """As in an environment with --system-site-packages, whose folders come after its own."""
    system = write(tmp_path / "system", {"tf2_ros/__init__.py": "ROS1 = True", "geometry_msgs/__init__.py": "ROS1 = 1"})
    link = installed.packages / "zz_system.pth"
    link.write_text(f"{system}\n")
    try:
        code = "import tf2_ros, geometry_msgs; print(tf2_ros.ROS1, geometry_msgs.ROS1)"
        assert installed.run("-c", code, cwd=tmp_path).stdout == "True 1\n"
        mixed = installed.run("-c", "import geometry_msgs, rclpy", cwd=tmp_path).stderr
        assert f"geometry_msgs was imported from {system}" in mixed
        assert "Import rclpy first" in mixed
        code = "import rclpy, geometry_msgs.msg, tf2_ros; print(tf2_ros.__file__)"
        done = installed.run("-c", code, cwd=tmp_path)
        assert done.stdout == f"{installed.packages}/coframe/ros/tf2_ros/__init__.py\n", done.stderr
        write(system, {"rclpy/__init__.py": "ROS2 = True"})
        assert installed.run("-c", "import rclpy; print(rclpy.ROS2)", cwd=tmp_path).stdout == "True\n"
    finally:
        link.unlink()


def test_the_folder_may_be_on_the_path_twice(installed, tmp_path):
    """As if PYTHONPATH names it as well."""
    folder = installed.packages / "coframe/ros"
    code = f"import sys; sys.path.append({str(folder)!r}); import rclpy, tf2_ros; print(rclpy.__file__)"
    for variables in ({}, {"PYTHONPATH": str(folder)}):
        done = installed.run("-c", code, cwd=tmp_path, **variables)
        assert done.stdout == f"{folder}/rclpy/__init__.py\n", done.stderr


def test_removing_coframe_removes_it_from_the_search(installed, tmp_path):
    """As in isolated builds of pip: Python runs the .pth files of the environment, but cannot import its packages."""
    code = "import sys\nsys.path[:] = [f for f in sys.path if 'site-packages' not in f]\n" + FAILING
    done = installed.run("-c", code + "print('done')", cwd=tmp_path)
    assert (done.stdout, done.stderr) == ("done\n", "")


def test_this_file_has_no_hidden_import():
    """The template imports nothing but sys, which every Python has."""
    line = (Path(__file__).parents[2] / "src/coframe_ros.pth.in").read_text().splitlines()[-1]
    tree = ast.parse(line)
    assert [alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names] == ["sys"]
