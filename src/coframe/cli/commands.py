# SPDX-License-Identifier: Apache-2.0
"""The table of commands, with one row per command and all properties that other modules need.

A new command is a module with a click command, and a row here. Tests fail until the row is correct.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Container

__all__ = ["COMMANDS", "CommandRow", "joins_graph"]


class CommandRow(NamedTuple):
    """The properties of a command that are known without importing its module.

    Attributes:
        line: The line in ``coframe --help``.
        module: The module below ``coframe.cli``; the command in it has the last part of the command's name.
        extras: The extras besides ``cli`` whose packages the command may need.
        graph: Whether the command joins the ROS graph, so that it has the option ``--wire``; for a group, the names of
            the commands that do.
        ros: Whether the command uses the ROS packages (``src/ros``).
    """

    line: str
    module: str
    extras: tuple[str, ...]
    graph: bool | frozenset[str]
    ros: bool


_BAG_GRAPH = frozenset({"record", "play", "burst"})
# name: line in the help, module, extras, joins the graph, uses ROS packages
COMMANDS: dict[str, CommandRow] = {
    "demo": CommandRow(
        "Start a simulated robot and show its moving transform tree.", "demo", ("dds", "viewer"), graph=True, ros=True
    ),
    "lab": CommandRow(
        "Work on the lab and grade it: new, run, check, break.",
        "lab",
        ("dds", "viewer", "robots"),
        graph=True,
        ros=True,
    ),
    "view": CommandRow(
        "Show frames, sensor data and markers in a browser tab.",
        "view",
        ("dds", "viewer", "bags", "robots"),
        graph=True,
        ros=True,
    ),
    "doctor": CommandRow(
        "Find problems with transforms, live or in a recording.", "doctor", ("dds", "bags"), graph=True, ros=True
    ),
    "contract": CommandRow(
        "State what a good recording contains, and check recordings.",
        "contract",
        ("dds", "bags"),
        graph=frozenset({"check"}),
        ros=False,
    ),
    "calib": CommandRow("Read, convert and compare calibrations.", "calib", ("bags", "robots"), graph=False, ros=False),
    "calibrate": CommandRow(
        "Estimate the mount and the time offset of a sensor.",
        "calibrate",
        ("bags", "calibration", "plot"),
        graph=False,
        ros=False,
    ),
    "why": CommandRow("Explain why a transform is or is not available.", "why", ("dds", "bags"), graph=True, ros=False),
    "frames": CommandRow(
        "Show the transform trees, or write a diagram of them.",
        "frames",
        ("dds", "bags", "pdf", "plot"),
        graph=True,
        ros=False,
    ),
    "monitor": CommandRow(
        "Show rate, jitter, delay and age of live transforms.", "monitor", ("dds",), graph=True, ros=False
    ),
    "echo": CommandRow("Print a live transform repeatedly, like tf2_echo.", "echo", ("dds",), graph=True, ros=False),
    "static": CommandRow(
        "Publish a static transform, like static_transform_publisher.", "static", ("dds",), graph=True, ros=False
    ),
    "robot": CommandRow(
        "Publish a robot's transforms, like robot_state_publisher.",
        "robot",
        ("dds", "robots", "params"),
        graph=True,
        ros=True,
    ),
    "joints": CommandRow(
        "Publish joint states, like joint_state_publisher.",
        "joints",
        ("dds", "robots", "params", "viewer"),
        graph=True,
        ros=True,
    ),
    "launch": CommandRow(
        "Launch the nodes of a launch file, like ros2 launch.",
        "launch",
        ("dds", "params", "robots"),
        graph=True,
        ros=True,
    ),
    "run": CommandRow("Run an executable of a package, like ros2 run.", "run", ("dds",), graph=True, ros=False),
    "hub": CommandRow(
        "Receive transforms once for all programs that share them.", "hub", ("dds",), graph=True, ros=False
    ),
    "relay": CommandRow("Merge or split the transforms of several robots.", "relay", ("dds",), graph=True, ros=False),
    "router": CommandRow(
        "Run a Zenoh router, which connects nodes across networks.", "router", ("zenoh",), graph=False, ros=False
    ),
    "record": CommandRow(
        "Record topics as MCAP files in rosbag2's layout.", "record", ("dds", "bags"), graph=True, ros=False
    ),
    "play": CommandRow("Replay a recording.", "play", ("dds", "bags"), graph=True, ros=False),
    "bag": CommandRow(
        "Record, play, inspect, repair, convert and cut recordings.",
        "bag",
        ("bags", "dds"),
        graph=_BAG_GRAPH,
        ros=True,
    ),
    "lookup": CommandRow(
        "Print a transform once, live or from a recording.", "lookup", ("dds", "bags"), graph=True, ros=False
    ),
    "trajectory": CommandRow(
        "Write the trajectory of a frame from a recording.", "trajectory", ("bags", "parquet"), graph=False, ros=False
    ),
    "table": CommandRow(
        "Write fields and poses at the stamps of a topic as a table.",
        "table",
        ("bags", "parquet"),
        graph=False,
        ros=False,
    ),
    "compare": CommandRow(
        "Compare two trajectories: absolute and relative pose errors.",
        "compare",
        ("bags", "plot"),
        graph=False,
        ros=False,
    ),
    "plot": CommandRow(
        "Plot poses, fields, rates and delays over time.", "plot", ("bags", "plot"), graph=False, ros=False
    ),
    "cloud": CommandRow(
        "Write point clouds or scans from a recording in one frame.", "cloud", ("bags",), graph=False, ros=False
    ),
    "batch": CommandRow(
        "Write trajectories from many recordings as one dataset.",
        "batch",
        ("bags", "parquet"),
        graph=False,
        ros=False,
    ),
    "topic": CommandRow(
        "Inspect and publish topics, like ros2 topic.", "ros2.topic", ("dds", "params"), graph=True, ros=True
    ),
    "node": CommandRow("List and inspect nodes, like ros2 node.", "ros2.node", ("dds",), graph=True, ros=True),
    "service": CommandRow(
        "List and call services, like ros2 service.", "ros2.service", ("dds", "params"), graph=True, ros=True
    ),
    "action": CommandRow(
        "List actions and send goals, like ros2 action.", "ros2.action", ("dds", "params"), graph=True, ros=True
    ),
    "param": CommandRow(
        "Read and set parameters of nodes, like ros2 param.", "ros2.param", ("dds", "params"), graph=True, ros=True
    ),
    "lifecycle": CommandRow(
        "Change the states of lifecycle nodes, like ros2 lifecycle.", "ros2.lifecycle", ("dds",), graph=True, ros=True
    ),
    "component": CommandRow(
        "Load composable nodes into one process, like ros2 component.",
        "ros2.component",
        ("dds", "params"),
        graph=frozenset({"list", "load", "standalone", "unload"}),
        ros=True,
    ),
    "interface": CommandRow(
        "Show types, like ros2 interface, and add your own packages.",
        "ros2.interface",
        ("params",),
        graph=False,
        ros=True,
    ),
    "pkg": CommandRow("Create and find packages, like ros2 pkg.", "ros2.pkg", (), graph=False, ros=False),
    "ros2": CommandRow(
        "Add the executables of ROS 2 if no ROS is installed.", "ros2.installing", (), graph=False, ros=False
    ),
}


def joins_graph(path: tuple[str, ...]) -> bool:
    """Return whether a command joins the ROS graph.

    Args:
        path: The words of the command, such as ``("bag", "record")``.
    """
    if not path or path[0] not in COMMANDS:
        return False
    graph: bool | Container[str] = COMMANDS[path[0]].graph
    return graph if isinstance(graph, bool) else path[-1] in graph
