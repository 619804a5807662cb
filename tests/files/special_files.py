# SPDX-License-Identifier: Apache-2.0
"""Files that are not what their names promise, and the functions of coframe that read files of each kind."""

from __future__ import annotations

import importlib.util
import os
import socket
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

TERABYTE = 1 << 40
MAGIC = {".mcap": b"\x89MCAP0\r\n", ".db3": b"SQLite format 3\0", ".bag": b"#ROSBAG V2.0\n", ".npz": b"PK\x03\x04"}


@dataclass(frozen=True)
class Kind:
    """A kind of file.

    Attributes:
        make: Creates it at a path.
        sentence: What the error contains; "" if that depends on the reader.
    """

    make: Callable[[Path], object]
    sentence: str = ""


def _socket(path: Path) -> None:
    """Create a socket; its address may have only about 100 characters, so it is relative."""
    before = Path.cwd()
    os.chdir(path.parent)
    try:
        with socket.socket(socket.AF_UNIX) as created:
            created.bind(path.name)
    finally:
        os.chdir(before)


def _sparse(path: Path) -> None:
    path.write_bytes(MAGIC.get(path.suffix, b" ") + bytes(4096))
    os.truncate(path, TERABYTE)


def _hole(path: Path) -> None:
    path.touch()
    os.truncate(path, TERABYTE)


def _pipe(path: Path) -> None:
    os.mkfifo(path)


KINDS: dict[str, Kind] = {
    "pipe": Kind(_pipe, "the path is a named pipe, not a regular file; write its content to a file first"),
    "zero": Kind(lambda path: path.symlink_to("/dev/zero"), "the path is a device"),
    "random": Kind(lambda path: path.symlink_to("/dev/urandom"), "the path is a device"),
    "socket": Kind(_socket, "the path is a socket"),
    "folder": Kind(lambda path: path.mkdir()),
    "loop": Kind(lambda path: path.symlink_to(path.name)),
    "nowhere": Kind(lambda path: path.symlink_to("nowhere")),
    "kernel": Kind(lambda path: path.symlink_to("/proc/self/environ")),
    "memory": Kind(lambda path: path.symlink_to("/proc/self/mem")),
    "sparse": Kind(_sparse, "the file is sparse"),
    "hole": Kind(_hole),
}
"""By name. `sentence` is empty where the reader finds other words, such as those for a missing file."""


@dataclass(frozen=True)
class Reader:
    """A function that reads a file.

    Attributes:
        file: The name of the file.
        read: Reads the file at a path.
        errors: The exceptions that it may raise.
    """

    file: str
    read: Callable[[Path], Any]
    errors: tuple[type[Exception], ...]


def readers() -> dict[str, Reader]:
    """Return the readers by name; what they need is imported here."""
    import coframe
    from ament_index_python import get_resource
    from coframe.bags import repair
    from coframe.errors import CoframeError, InterfaceError, PackageError, RobotDescriptionError, ViewerError, WireError
    from coframe.interfaces.definition_files import read as read_definition
    from coframe.robots import Packages
    from coframe.robots import load as load_robot
    from coframe.trajectories import read_trajectory
    from coframe.viewer.robots.meshes import MeshTable
    from coframe.viewer.rviz.config import RvizConfig
    from coframe.wire.dds.config import cyclone_config
    from coframe.wire.zenoh.config import session_config
    from coframe.workspace.packages import _console_scripts as console_scripts
    from coframe.workspace.packages import folders
    from launch import LaunchContext
    from launch.invalid_launch_file_error import InvalidLaunchFileError
    from launch.launch_description_sources import get_launch_description_from_any_launch_file
    from launch.substitutions import FileContent
    from launch.substitutions.substitution_failure import SubstitutionFailure
    from rclpy.parameter import parameter_dict_from_yaml_file
    from rosbag2_py import MetadataIo

    def included(path: Path) -> None:
        main = path.with_name("main.xacro")
        include = f'<xacro:include filename="{path}"/>'
        main.write_text(f'<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">{include}</robot>')
        load_robot(main)

    def resource(path: Path) -> None:
        before = os.environ.get("AMENT_PREFIX_PATH", "")
        index = path.parent / "share" / "ament_index" / "resource_index" / "kind"
        index.mkdir(parents=True, exist_ok=True)
        (index / path.name).symlink_to(path)
        os.environ["AMENT_PREFIX_PATH"] = str(path.parent)
        try:
            get_resource("kind", path.name)
        finally:
            os.environ["AMENT_PREFIX_PATH"] = before

    def declared(path: Path) -> None:
        assert console_scripts.read(path.parent).scripts == {}

    def zenoh_certificate(path: Path) -> None:
        override = f"transport/link/tls/root_ca_certificate='{path}'"
        session_config({"ZENOH_CONFIG_OVERRIDE": override})

    def launch(path: Path) -> None:
        get_launch_description_from_any_launch_file(str(path))

    def recording(path: Path) -> None:
        coframe.open_bag(path).close()

    def recording_around(path: Path) -> None:
        coframe.open_bag(path.parent).close()

    def repaired(path: Path) -> None:
        repair(path, path.with_name("repaired"))

    def rosbag2_metadata(path: Path) -> None:
        MetadataIo().read_metadata(str(path.parent))

    def packaged_file(path: Path) -> None:
        Packages(path.parent).resolve(path.name)

    def mesh(path: Path) -> None:
        MeshTable(lambda _: None, [path.parent]).url(f"file://{path}")

    def file_content(path: Path) -> None:
        FileContent(str(path)).perform(LaunchContext())

    def parameters(path: Path) -> None:
        parameter_dict_from_yaml_file(str(path))

    def manifest(path: Path) -> None:
        folders.package_name(path.parent)

    def cyclone(path: Path) -> None:
        cyclone_config({"CYCLONEDDS_URI": f"file://{path}"})

    def zenoh(path: Path) -> None:
        session_config({"ZENOH_SESSION_CONFIG_URI": str(path)})

    of_recordings = (coframe.RecordingError,)
    of_robots = (RobotDescriptionError,)
    of_trajectories = (coframe.TrajectoryError,)
    of_launch_files = (InvalidLaunchFileError, OSError, SyntaxError, ValueError)
    zenoh_readers = {
        "zenoh_config": Reader("zenoh.json5", zenoh, (WireError,)),
        "zenoh_certificate": Reader("ca.pem", zenoh_certificate, (WireError,)),
    }
    return {
        "mcap": Reader("run.mcap", recording, of_recordings),
        "sqlite": Reader("run.db3", recording, of_recordings),
        "ros1_bag": Reader("run.bag", recording, of_recordings),
        "packed_bag": Reader("run.db3.zstd", recording, of_recordings),
        "metadata": Reader("metadata.yaml", recording_around, of_recordings),
        "file_in_a_folder": Reader("run_0.mcap", recording_around, of_recordings),
        "repaired": Reader("run.mcap", repaired, of_recordings),
        "rosbag2_metadata": Reader("metadata.yaml", rosbag2_metadata, (RuntimeError,)),
        "frozen": Reader("run.cfz", coframe.load, (coframe.FrozenFileError,)),
        "urdf": Reader("robot.urdf", load_robot, of_robots),
        "xacro": Reader("robot.xacro", load_robot, of_robots),
        "included_xacro": Reader("part.xacro", included, of_robots),
        "packaged_file": Reader("mesh.stl", packaged_file, (PackageError,)),
        "mesh": Reader("mesh.stl", mesh, (CoframeError,)),
        "rviz": Reader("view.rviz", RvizConfig.load, (ViewerError,)),
        "tum": Reader("path.tum", read_trajectory, of_trajectories),
        "csv": Reader("path.csv", read_trajectory, of_trajectories),
        "npz": Reader("path.npz", read_trajectory, of_trajectories),
        "python_launch": Reader("a.launch.py", launch, of_launch_files),
        "xml_launch": Reader("a.launch.xml", launch, of_launch_files),
        "yaml_launch": Reader("a.launch.yaml", launch, of_launch_files),
        "file_content": Reader("text.txt", file_content, (SubstitutionFailure,)),
        "parameters": Reader("parameters.yaml", parameters, (RuntimeError,)),
        "manifest": Reader("package.xml", manifest, ()),
        "setup_py": Reader("setup.py", declared, ()),
        "setup_cfg": Reader("setup.cfg", declared, ()),
        "pyproject": Reader("pyproject.toml", declared, ()),
        "resource": Reader("name", resource, (OSError, LookupError, UnicodeDecodeError)),
        "definition": Reader("A.msg", read_definition, (InterfaceError,)),
        "cyclone_config": Reader("dds.xml", cyclone, (WireError,)),
        **(zenoh_readers if importlib.util.find_spec("zenoh") else {}),
    }
