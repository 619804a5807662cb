# SPDX-License-Identifier: Apache-2.0
"""The programs that were recorded on ROS 2 Humble, and their output with coframe."""

import os
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import pytest

pytest.importorskip("dds_library", reason="the programs speak DDS")

RUNNER = Path(__file__).with_name("run_program.py")
ARGUMENTS = Path(__file__).with_name("arguments.py")
# What a sourced ROS 2 sets, so that its packages are imported instead of those of coframe.
ROS_VARIABLES = ("PYTHONPATH", "AMENT_PREFIX_PATH", "COLCON_PREFIX_PATH", "CMAKE_PREFIX_PATH", "ROS_DISTRO")
PARALLEL = 4  # they mostly wait
# The recorded programs ran in this domain, which one of them prints.
FIRST_DOMAIN = 11


def names(folder: Path) -> list[str]:
    """Return the names of the programs, the one that prints its domain first."""
    found = sorted(path.stem for path in folder.glob("e[0-9]*.py"))
    return sorted(found, key=lambda name: not name.startswith("e05"))


def run(network, folder: Path, python: str, environment: dict[str, str], name: str, domain: int) -> str:
    """Return what a program prints to stdout, and its exit code."""
    path = ARGUMENTS if name == "bad" else folder / f"{name}.py"
    arguments = folder / f"{name}.args"
    words = shlex.split(arguments.read_text()) if arguments.exists() else []
    process = subprocess.run(
        network.command(python, RUNNER, path, *words),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT if name == "bad" else subprocess.DEVNULL,
        text=True,
        timeout=120,
        check=False,
        cwd=folder,
        env=environment | {"ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"},
    )
    return process.stdout if name == "bad" else f"{process.stdout}rc={process.returncode}\n"


def run_all(network, folder: Path, python: str, environment: dict[str, str]) -> dict[str, str]:
    """Return the outputs of all programs, which run in their own domains."""
    programs = [*names(folder), "bad"]
    with ThreadPoolExecutor(PARALLEL) as pool:
        outputs = pool.map(
            partial(run, network, folder, python, environment),
            programs,
            range(FIRST_DOMAIN, FIRST_DOMAIN + len(programs)),
        )
        return dict(zip(programs, outputs, strict=True))


@pytest.fixture(scope="session")
def with_coframe(shared, session_network) -> dict[str, str]:
    """Return what the programs print with coframe."""
    return run_all(session_network, shared / "interop" / "rclpy", sys.executable, environment_of_coframe())


@pytest.fixture
def run_again(shared, session_network):
    """Return a function that runs a program alone: some print whether timers kept their period."""
    folder = shared / "interop" / "rclpy"
    return lambda name: run(session_network, folder, sys.executable, environment_of_coframe(), name, FIRST_DOMAIN)


@pytest.fixture(scope="session")
def with_distribution(shared, session_network):
    """Return a function that returns what the programs print with coframe on a distribution."""

    if "COFRAME_TEST_ROS" in os.environ:
        pytest.skip("the other outputs are those of the sourced distribution")

    def outputs(distribution: str) -> dict[str, str]:
        environment = environment_of_coframe() | {"COFRAME_DISTRO": distribution}
        return run_all(session_network, shared / "interop" / "rclpy", sys.executable, environment)

    return outputs


def environment_of_coframe() -> dict[str, str]:
    """Return the environment without a sourced ROS 2; coframe follows its distribution, or that of the recordings."""
    distribution = os.environ.get("ROS_DISTRO", "humble") if "COFRAME_TEST_ROS" in os.environ else "humble"
    others = {name: value for name, value in os.environ.items() if name not in ROS_VARIABLES}
    return others | {"COFRAME_DISTRO": distribution}


@pytest.fixture(scope="session")
def with_ros(shared, session_network) -> dict[str, str]:
    """Return what the programs print with ROS 2: the recorded outputs, or those of the sourced one (make test-ros)."""
    folder = shared / "interop" / "rclpy"
    if "COFRAME_TEST_ROS" not in os.environ:
        return {name: (folder / f"{name}.humble.txt").read_text() for name in [*names(folder), "bad"]}
    if "ROS_DISTRO" not in os.environ:
        pytest.skip("no ROS 2 is sourced")
    return run_all(session_network, folder, "python3", dict(os.environ))
