# SPDX-License-Identifier: Apache-2.0
"""The fuzz targets in Python: functions that read untrusted bytes and raise only the errors that users are promised.

``python python_targets.py NAME [libFuzzer's options] [FOLDER...]`` fuzzes one target with atheris. A single file
instead of the folders is run once. ``--once`` runs files without atheris, as the tests do.
"""

from __future__ import annotations

import asyncio
import contextlib
import io
import logging
import os
import shlex
import shutil
import socket
import sys
import tempfile
from importlib.machinery import PathFinder
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

TARGETS: dict[str, Callable[[], Callable[[bytes], object]]] = {}
MESSAGE_TYPES = (
    "tf2_msgs/msg/TFMessage",
    "sensor_msgs/msg/PointCloud2",
    "sensor_msgs/msg/LaserScan",
    "sensor_msgs/msg/JointState",
    "visualization_msgs/msg/MarkerArray",
    "nav_msgs/msg/OccupancyGrid",
    "rcl_interfaces/msg/ParameterEvent",
    "diagnostic_msgs/msg/DiagnosticArray",
)
SENSOR_TYPES = ("sensor_msgs/msg/Image", "sensor_msgs/msg/LaserScan", "sensor_msgs/msg/PointCloud2")
_MAX_MESSAGES = 20_000  # most messages of a recording that a target reads


def target(make: Callable[[], Callable[[bytes], object]]) -> Callable[[], Callable[[bytes], object]]:
    """Register a function that imports what a target needs and returns the target."""
    TARGETS[make.__name__] = make
    return make


@target
def messages() -> Callable[[bytes], object]:
    """Decode messages of several types; what can be decoded can be encoded and decoded again."""
    from coframe.errors import DecodeError
    from coframe.messages import deserialize, find, serialize
    from coframe.messages.header_peek import peek_header

    classes = [find(name) for name in MESSAGE_TYPES]

    def run(data: bytes) -> None:
        if not data:
            return
        peek_header(data[1:])
        with contextlib.suppress(DecodeError):
            message = deserialize(data[1:], classes[data[0] % len(classes)])
            try:
                again = serialize(message)
            except ValueError:  # a string that contains a NUL
                return
            assert serialize(deserialize(again, type(message))) == again

    return run


class OneMessage:
    """A topic with one message, as displays read it."""

    def __init__(self, message: Any) -> None:
        from coframe.viewer.sources.topic_messages import StampedMessage

        self.type = message.ROS_TYPE
        self.message = StampedMessage(1, 1, lambda: message)

    def before(self, _time: int, _count: int) -> list[Any]:
        """Return the message."""
        return [self.message]

    def after(self, key: int, _last: int) -> list[Any]:
        """Return the message unless it is known."""
        return [self.message] if key < self.message.key else []


def displayed_types() -> list[str]:
    """Return the types that the viewer displays, but for one whose definition is not part of coframe."""
    from coframe.viewer.displays.rows import DISPLAY_OF_TYPE

    return sorted(set(DISPLAY_OF_TYPE) - {"ffmpeg_image_transport_msgs/msg/FFMPEGPacket"})


@target
def displays() -> Callable[[bytes], object]:
    """Draw messages of all types that the viewer displays."""
    from coframe.errors import DecodeError
    from coframe.messages import deserialize, find
    from coframe.viewer.displays import CannotDrawError, Options
    from coframe.viewer.displays.resources import Resources
    from coframe.viewer.displays.rows import make_renderer

    types = displayed_types()
    classes = [find(name) for name in types]

    def run(data: bytes) -> None:
        if not data:
            return
        number = data[0] % len(classes)
        with contextlib.suppress(DecodeError, CannotDrawError):
            topic = OneMessage(deserialize(data[1:], classes[number]))
            for drawing in make_renderer(topic, Options(), Resources()).draw(topic.message, 0, 0):
                drawing.take_data()

    return run


@target
def sensor_messages() -> Callable[[bytes], object]:
    """Convert images, scans and clouds to arrays, and transform clouds."""
    import coframe
    from coframe.messages import deserialize, find
    from coframe.sensors import project_scan, transform_cloud
    from cv_bridge import CvBridge, CvBridgeError
    from sensor_msgs_py.point_cloud2 import read_points

    classes = [find(name) for name in SENSOR_TYPES]
    pose = coframe.Transform([1, 2, 3], [0, 0, 0, 1])
    convert = (CvBridge().imgmsg_to_cv2, project_scan, read_points)

    def run(data: bytes) -> None:
        if not data:
            return
        number = data[0] % len(classes)
        with contextlib.suppress(coframe.CoframeError, CvBridgeError, ValueError):
            message = deserialize(data[1:], classes[number])
            with contextlib.suppress(AssertionError, KeyError):  # as sensor_msgs_py of ROS, for invalid fields
                convert[number](message)
            if SENSOR_TYPES[number] == "sensor_msgs/msg/PointCloud2":
                transform_cloud(message, pose)

    return run


@target
def definitions() -> Callable[[bytes], object]:
    """Parse the definitions of interfaces: .msg, .srv, .action and .idl."""
    from coframe.errors import InterfaceError
    from coframe.messages._idl import parse_idl
    from coframe.messages._parser import parse

    def run(data: bytes) -> None:
        text = data[1:].decode("utf-8", "replace")
        with contextlib.suppress(InterfaceError):
            if data[:1] == b"i":
                parse_idl(text, "lab", "msg", "P")
            else:
                parse(text, "lab", 1 + len(data) % 3)

    return run


@target
def schemas() -> Callable[[bytes], object]:
    """Read the definition of a recorded message, and decode a message by it: the text, a NUL, and the bytes."""
    import coframe
    from coframe.bags._decoding import decoder
    from coframe.bags._problems import Problems
    from coframe.bags._recorded_types import RecordedTypes
    from coframe.bags.storage import Channel
    from coframe.messages import Message, serialize

    formats = (("cdr", "ros2msg"), ("ros1", "ros1msg"), ("cdr", "ros2idl"), ("protobuf", "protobuf"), ("cdr", "omgidl"))

    def run(data: bytes) -> None:
        if not data:
            return
        encoding, format_ = formats[data[0] % len(formats)]
        definition, _, message = data[1:].partition(b"\0\0\0\0")
        name = "lab.P" if encoding == "protobuf" else "lab/msg/P"
        channel = Channel("/p", name, encoding, definition, format_)
        types = RecordedTypes()
        types.stamp_reader(channel), types.peek_header(channel, message), types.may_have_header(channel)
        decode = decoder(channel, types, Problems())
        for content in (message, b"\0\1\0\0" + message, b"\0\1\0\0" + bytes(200)):
            with contextlib.suppress(coframe.DecodeError):
                decoded = decode(content)
                repr(decoded)
                if isinstance(decoded, Message) and encoding == "cdr":
                    with contextlib.suppress(ValueError):  # a number in a wide text that is half of a surrogate pair
                        serialize(decoded)

    return run


@target
def discovery() -> Callable[[bytes], object]:
    """Decode what other participants publish about themselves."""
    from coframe.wire.names import any_ros_name, full_name, ros_type
    from coframe.wire.rtps.discovery_info import decode_info, encode_info
    from coframe.wire.rtps.user_data import type_hash_of

    def run(data: bytes) -> None:
        type_hash_of(data)
        text = data.decode("utf-8", "replace")
        any_ros_name(text), ros_type(text)
        info = decode_info(data)
        if info is not None:
            for node in info.nodes:
                full_name(node.namespace, node.name)
            again = decode_info(encode_info(info.participant, info.nodes, info.gid_size))
            assert again is not None
            assert again.participant == info.participant

    return run


def _recording(suffix: str) -> Callable[[bytes], object]:
    """Return a target that reads a recording as `bag info`, `doctor` and the conversions do."""
    import coframe
    from coframe.bags._offered_qos import from_yaml
    from coframe.doctor import diagnose, observe_recording

    def read(path: Path) -> None:
        with coframe.open_bag(path) as recording:
            for channel in recording.channels():
                from_yaml(channel.offered_qos)
            for topic in recording.topics:
                recording.stamps(topic)
                for number, message in enumerate(recording.messages(topic)):
                    with contextlib.suppress(coframe.DecodeError):
                        _ = message.message
                    if number > _MAX_MESSAGES:
                        break
        for observation in observe_recording(path).values():
            diagnose(observation)

    def run(data: bytes) -> None:
        path = _scratch() / f"recording{suffix}"
        path.write_bytes(data)
        with contextlib.suppress(coframe.CoframeError):
            read(path)

    return run


@target
def mcap() -> Callable[[bytes], object]:
    """Read an MCAP file."""
    return _recording(".mcap")


@target
def sqlite() -> Callable[[bytes], object]:
    """Read a database of rosbag2."""
    return _recording(".db3")


@target
def ros1_bag() -> Callable[[bytes], object]:
    """Read a bag of ROS 1."""
    return _recording(".bag")


@target
def repair() -> Callable[[bytes], object]:
    """Repair an MCAP file; the result can be read."""
    import coframe
    from coframe.bags._bag_repair import repair as repair_bag

    def run(data: bytes) -> None:
        folder = _scratch()
        source, result = folder / "damaged.mcap", folder / "repaired"
        source.write_bytes(data)
        shutil.rmtree(result, ignore_errors=True)
        with contextlib.suppress(coframe.RecordingError):
            repair_bag(source, result)
            with coframe.open_bag(result) as recording:
                list(recording.channels())

    return run


@target
def metadata() -> Callable[[bytes], object]:
    """Read a folder of rosbag2 with this metadata.yaml, and the text as the offered quality of service."""
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "bags"))
    import recordings

    import coframe
    from coframe.bags._offered_qos import from_yaml

    folder = _scratch() / "walk"
    recordings.write_rosbag2(folder, rows=recordings.messages()[:6])

    def run(data: bytes) -> None:
        from_yaml(data.decode("utf-8", "replace"))
        (folder / "metadata.yaml").write_bytes(data)
        with contextlib.suppress(coframe.CoframeError), coframe.open_bag(folder) as recording:
            list(recording.channels())

    return run


@target
def frozen_file() -> Callable[[bytes], object]:
    """Open a file of a frozen buffer whose checksums are right."""
    import struct
    import zlib

    import coframe

    def run(data: bytes) -> None:
        # The checksums are computed here: the fuzzer cannot guess them.
        content = bytearray(data)
        if len(content) > 72:
            table, size = struct.unpack_from("<QQ", content, 48)
            if table <= len(content):
                struct.pack_into("<I", content, 12, zlib.crc32(content[table : table + size]))
            struct.pack_into("<I", content, 64, zlib.crc32(content[:64]))
        path = _scratch() / "buffer.cfz"
        path.write_bytes(content)
        with contextlib.suppress(coframe.CoframeError):
            buffer = coframe.load(path)
            names = buffer.frame_names()
            for name in names[:3]:
                buffer.can_transform(names[0], name)
            buffer.edges()
            buffer.verify()

    return run


@target
def urdf() -> Callable[[bytes], object]:
    """Parse a URDF, and compute the poses of its links."""
    from coframe.robots import RobotDescriptionError, parse_urdf

    def run(data: bytes) -> None:
        with contextlib.suppress(RobotDescriptionError):
            robot = parse_urdf(data)
            robot.frames()

    return run


@target
def xacro() -> Callable[[bytes], object]:
    """Expand a xacro file, in a process with limits of its own."""
    from coframe.robots import RobotDescriptionError, load

    def run(data: bytes) -> None:
        path = _scratch() / "robot.xacro"
        path.write_bytes(data)
        with contextlib.suppress(RobotDescriptionError):
            load(path)

    return run


@target
def rviz() -> Callable[[bytes], object]:
    """Read a configuration of RViz, and write it again."""
    from coframe.errors import ViewerError
    from coframe.viewer.rviz.config import RvizConfig

    def run(data: bytes) -> None:
        with contextlib.suppress(ViewerError):
            config = RvizConfig.parse(data.decode("utf-8", "replace"))
            config.description()
            RvizConfig.parse(config.with_fixed_frame("odom").text())

    return run


@target
def mesh_names() -> Callable[[bytes], object]:
    """Find the meshes that robots and markers name, and the files that pages request."""
    from coframe.viewer.robots.meshes import MeshError, MeshTable

    folder = _scratch() / "served"
    (folder / "meshes").mkdir(parents=True)
    (folder / "meshes" / "a.stl").write_bytes(b"solid")
    (folder.parent / "secret.stl").write_bytes(b"secret")
    table = MeshTable(lambda name: folder if name == "lab" else None, [folder])
    token = table.url("package://lab/meshes/a.stl").split("/")[2]

    def run(data: bytes) -> None:
        name = data.decode("utf-8", "surrogateescape")
        with contextlib.suppress(MeshError):
            assert table.url(name, folder).startswith("/mesh/")
        with contextlib.suppress(MeshError):
            assert table.file(f"{token}/{name}").is_relative_to(folder.resolve())

    return run


@target
def viewer_messages() -> Callable[[bytes], object]:
    """Send messages of a client to the viewer, one per line."""
    import coframe
    from coframe.viewer._state import ViewerState
    from coframe.viewer.clients.client import Client
    from coframe.viewer.sources.source import BufferSource

    buffer = coframe.Buffer(None)
    buffer.set("odom", "base", coframe.Transform([1, 2, 3], [0, 0, 0, 1]), 1_000_000_000)
    loop = asyncio.new_event_loop()
    asyncio.set_event_loop(loop)
    problems = _logged_problems()

    class Connection:
        """A connection to a page that receives everything."""

        is_clear = True

        async def cleared(self) -> None:
            """Return immediately."""

        def send(self, message: str | bytes | bytearray) -> None:
            """Drop the message."""

        def pause(self) -> None:
            """Do nothing."""

        def resume(self) -> None:
            """Do nothing."""

        def abort(self) -> None:
            """Report that the viewer has disconnected the page, which it does after an error of its own."""
            problems.append("the viewer disconnected the client")

    state = ViewerState(BufferSource(buffer))

    async def talk(lines: list[str]) -> None:
        client = Client(Connection(), state)
        for line in lines:
            client.receive(line)
            client.update(asyncio.get_running_loop().time())
            if client._answer_task is not None:
                await client._answer_task
        client.disconnected()

    def run(data: bytes) -> None:
        loop.run_until_complete(talk(data.decode("utf-8", "replace").split("\n")[:64]))
        _raise_all(problems)

    return run


@target
def viewer_socket() -> Callable[[bytes], object]:
    """Send bytes to the viewer's port: HTTP requests and WebSockets."""
    import coframe
    from coframe.viewer._state import ViewerState
    from coframe.viewer.server.server import ViewerServer
    from coframe.viewer.sources.source import BufferSource

    buffer = coframe.Buffer(None)
    buffer.set("odom", "base", coframe.Transform([1, 2, 3], [0, 0, 0, 1]), 1_000_000_000)
    server = ViewerServer(ViewerState(BufferSource(buffer)), host="127.0.0.1", port=0)
    problems = _logged_problems()
    port = str(server.port).encode()

    def run(data: bytes) -> None:
        with (
            socket.create_connection(("127.0.0.1", server.port), timeout=4.5) as connection,
            contextlib.suppress(ConnectionError),
        ):
            connection.sendall(data.replace(b"7676", port))
            connection.shutdown(socket.SHUT_WR)
            while connection.recv(1 << 16):
                pass
        _raise_all(problems)

    return run


def _launch_file(suffix: str) -> Callable[[bytes], object]:
    from launch import InvalidLaunchFileError
    from launch.launch_description_sources import get_launch_description_from_frontend_launch_file

    def run(data: bytes) -> None:
        path = _scratch() / f"lab.launch{suffix}"
        path.write_bytes(data)
        with contextlib.suppress(InvalidLaunchFileError):
            get_launch_description_from_frontend_launch_file(str(path))

    return run


@target
def launch_xml() -> Callable[[bytes], object]:
    """Parse a launch file in XML."""
    return _launch_file(".xml")


@target
def launch_yaml() -> Callable[[bytes], object]:
    """Parse a launch file in YAML."""
    return _launch_file(".yaml")


@target
def parameters() -> Callable[[bytes], object]:
    """Read a parameter file, and the text as the value of a parameter at the command line."""
    from rclpy._yaml import load_parameters, parse_value

    def run(data: bytes) -> None:
        path = _scratch() / "parameters.yaml"
        path.write_bytes(data)
        with contextlib.suppress(ValueError):
            load_parameters(str(path))
        with contextlib.suppress(ValueError):
            parse_value(data.decode("utf-8", "replace"))

    return run


@target
def trajectories() -> Callable[[bytes], object]:
    """Read a trajectory file: NPZ, CSV (EuRoC too), TUM or KITTI."""
    import coframe
    from coframe.trajectories import read_trajectory

    def run(data: bytes) -> None:
        suffix = "npz" if data.startswith(b"PK") else "csv" if b"," in data.partition(b"\n")[0] else "txt"
        path = _scratch() / f"path.{suffix}"
        path.write_bytes(data)
        with contextlib.suppress(coframe.CoframeError):
            read_trajectory(path)

    return run


class _Problems(logging.Handler):
    """Collects what the viewer logs: it logs only errors of its own."""

    def __init__(self, problems: list[str]) -> None:
        super().__init__(logging.ERROR)
        self._problems = problems
        self.setFormatter(logging.Formatter())

    def emit(self, record: logging.LogRecord) -> None:
        self._problems.append(self.format(record))


def _logged_problems() -> list[str]:
    problems: list[str] = []
    for name in ("coframe.viewer", "asyncio"):
        logging.getLogger(name).addHandler(_Problems(problems))
        logging.getLogger(name).propagate = False
    return problems


def _raise_all(problems: list[str]) -> None:
    if problems:
        found = "\n".join(problems)
        problems.clear()
        raise AssertionError(found)


def _scratch() -> Path:
    """Return the folder for the files of this process, in memory where the system has such a folder."""
    global _folder  # noqa: PLW0603 - atheris ends the process without any cleanup, so the runner deletes the folder
    if _folder is None:
        _folder = Path(tempfile.mkdtemp(prefix="coframe-fuzz-", dir=os.environ.get("COFRAME_FUZZ_SCRATCH")))
    return _folder


_folder: Path | None = None


def _fuzz(name: str, arguments: list[str]) -> None:
    import atheris

    # The loader of an editable installation hides the source from atheris.
    sys.path[:0] = [str(Path(__file__).resolve().parents[2] / folder) for folder in ("src", "src/ros")]
    sys.meta_path.insert(0, PathFinder)
    included = ["coframe", "launch", "launch_ros", "launch_xml", "launch_yaml", "rclpy"]
    with atheris.instrument_imports(include=included):
        run = TARGETS[name]()
        with contextlib.suppress(Exception):
            run(b"")  # imports the rest

    def quiet(data: bytes) -> None:
        with contextlib.redirect_stdout(io.StringIO()):
            run(data)

    # To merge corpora, libFuzzer gives the first argument to a shell, followed by its own options.
    command = shlex.join([sys.executable, str(Path(__file__).resolve()), name])
    atheris.Setup([command, *arguments], quiet)
    atheris.Fuzz()


def _run_once(name: str, files: list[str]) -> None:
    run = TARGETS[name]()
    for file in files:
        run(Path(file).read_bytes())


if __name__ == "__main__":
    if sys.argv[2:3] == ["--once"]:
        _run_once(sys.argv[1], sys.argv[3:])
    else:
        _fuzz(sys.argv[1], sys.argv[2:])
