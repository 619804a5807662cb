# SPDX-License-Identifier: Apache-2.0
"""The table of commands: each is a function, or a group, with the name of its module."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Annotated, Any

import typer

import coframe
from coframe.cli.help_format import PlainCommand, PlainGroup
from coframe.cli.ros_arguments import NodeCommand

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["COMMANDS", "build_app"]

# These commands pass unknown words on: --ros-args to a node, NAME:=VALUE to a xacro file.
_PASSES_WORDS_ON = {"context_settings": {"ignore_unknown_options": True, "allow_extra_args": True}}
# These replace tools of ROS 2 whose nodes are renamed by --ros-args.
_NODE = {"cls": NodeCommand}
# The line in `coframe --help`, and how the command is registered. `module` is its module if that does not have the name
# of the command; `cls` is a class, or the name of one in its module.
COMMANDS: dict[str, tuple[str, dict[str, Any]]] = {
    "demo": ("Start a simulated robot and show its moving transform tree.", {}),
    "lab": ("Do the lab, and grade it: new, run, check, break.", {}),
    "view": ("Show frames, sensor data and markers in a browser tab.", _NODE),
    "doctor": ("Find problems with transforms, live or in a recording.", {}),
    "why": ("Explain why a transform is available, or why it is not.", {}),
    "frames": ("Show the transform trees, or write a diagram of them.", _NODE),
    "monitor": ("Show rate, jitter, delay and age of live transforms.", _NODE),
    "echo": ("Print a live transform repeatedly, like tf2_echo.", _NODE),
    "static": (
        "Publish a static transform, like static_transform_publisher.",
        # Numbers of a transform may be negative, so the command reads its arguments itself.
        {"add_help_option": False, **_PASSES_WORDS_ON, **_NODE},
    ),
    "robot": ("Publish a robot's transforms, like robot_state_publisher.", _PASSES_WORDS_ON),
    "joints": ("Publish joint states, like joint_state_publisher.", _PASSES_WORDS_ON),
    "launch": ("Launch the nodes of a launch file, like ros2 launch.", _PASSES_WORDS_ON),
    # The arguments of the executable begin after its name, and may look like options.
    "run": (
        "Run an executable of a package, like ros2 run.",
        {"context_settings": {**_PASSES_WORDS_ON["context_settings"], "allow_interspersed_args": False}},
    ),
    "interfaces": ("Find, check and add your own .msg, .srv and .action files.", {}),
    "hub": ("Receive the transforms once for all programs that share them.", {}),
    "relay": ("Merge the transforms of several robots, or split them.", {}),
    "router": ("Run a Zenoh router, which connects nodes across networks.", {}),
    "record": ("Record topics as MCAP files in rosbag2's layout.", {}),
    "play": ("Replay a recording.", {"cls": "PlayCommand"}),
    "bag": ("Record, play, inspect, repair, convert and cut recordings.", {}),
    "lookup": ("Print a transform once, live or from a recording.", {}),
    "trajectory": ("Write the trajectory of a frame from a recording.", {}),
    "compare": ("Compare two trajectories: absolute and relative pose errors.", {}),
    "plot": ("Plot poses, fields, rates and delays over time.", {}),
    "cloud": ("Write point clouds or scans from a recording in one frame.", {}),
    "batch": ("Write trajectories from many recordings as one dataset.", {}),
    "topic": ("Inspect and publish topics, like ros2 topic.", {"module": "ros2.topic"}),
    "node": ("List and inspect nodes, like ros2 node.", {"module": "ros2.node"}),
    "service": ("List and call services, like ros2 service.", {"module": "ros2.service"}),
    "action": ("List actions and send goals, like ros2 action.", {"module": "ros2.action"}),
    "param": ("Read and set parameters of nodes, like ros2 param.", {"module": "ros2.param"}),
    "lifecycle": ("Change the states of lifecycle nodes, like ros2 lifecycle.", {"module": "ros2.lifecycle"}),
    "interface": ("Show message, service and action types, like ros2 interface.", {"module": "ros2.interface"}),
    "ros2": ("Add the executables ros2 and rviz2 where no ROS is installed.", {"module": "ros2.installing"}),
    "pkg": ("Create and find packages, like ros2 pkg.", {"module": "ros2.pkg"}),
}

_DESCRIPTIONS = {
    "coframe": "ROS 2's transform system (tf2) as one pip install: any frame, any time, on any machine.\n\n"
    "Example: coframe demo",
    "ros2": "The commands of ros2 that coframe provides where no ROS is installed. coframe --help lists more.\n\n"
    "Example: ros2 topic list",
}


def build_app(names: Iterable[str], existing: Iterable[str] = COMMANDS, program: str = "coframe") -> typer.Typer:
    """Return the command line; only the modules of the named commands are imported, and only these can run.

    Args:
        names: The commands to import.
        existing: The commands that the help lists.
        program: The name of the program in its help.
    """
    app = typer.Typer(
        name=program,
        cls=PlainGroup,
        help=_DESCRIPTIONS[program],
        no_args_is_help=True,
        # The commands of ros2 have -h, too.
        context_settings={"help_option_names": ["--help", "-h"]},
        pretty_exceptions_enable=False,
        # Plain text: panels cut the descriptions of options to half of an 80-column terminal.
        rich_markup_mode=None,
    )
    app.callback()(_main)
    imported = set(names)
    for name in existing:
        line, registration = COMMANDS[name]
        if name not in imported:
            app.command(name, cls=PlainCommand, short_help=line)(_not_imported)
            continue
        options = dict(registration)
        module = importlib.import_module(f"coframe.cli.{options.pop('module', name)}")
        command = getattr(module, name)
        if isinstance(command, typer.Typer):
            app.add_typer(command, name=name, cls=PlainGroup, short_help=line)
        else:
            cls = options.pop("cls", PlainCommand)
            cls = getattr(module, cls) if isinstance(cls, str) else cls
            app.command(**options, cls=cls, short_help=line)(command)
    return app


def _not_imported() -> None:
    """Stand for a command whose line in the help is known without its module."""


def _print_version(requested: bool) -> None:
    if requested:
        typer.echo(f"coframe {coframe.__version__}")
        raise typer.Exit


def _main(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Show the version and exit.")
    ] = False,
) -> None:
    pass
