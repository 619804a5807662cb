# SPDX-License-Identifier: Apache-2.0
"""``coframe robot``: publishes the transforms of a robot description, like robot_state_publisher."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from coframe.cli.declaration import PASS_ARGUMENTS_ON, PATH, Command, argument
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.node_arguments import reported_node_errors, ros_arguments, xacro_arguments
from coframe.cli.options import (
    domain_option,
    keep_option,
    prefix_option,
    tf_static_topic_option,
    tf_topic_option,
)
from coframe.robots import load

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["robot"]


@click.command(cls=Command, context_settings=PASS_ARGUMENTS_ON)
@click.pass_context
@argument("file", metavar="FILE", type=PATH, help="Robot description: a URDF or xacro file.")
@prefix_option
@keep_option
@click.option(
    "--frequency",
    "-f",
    metavar="HZ",
    type=click.FloatRange(min=0.0, max=1000.0),
    help="Maximum publishing rate of each joint, in Hz. [default: 20]",
)
@click.option(
    "--ignore-timestamp", is_flag=True, help="Publish for every joint state, regardless of its stamp and --frequency."
)
@domain_option
@tf_topic_option
@tf_static_topic_option
def robot(
    context: click.Context,
    file: Path,
    prefix: str,
    keep: str,
    frequency: float | None,
    ignore_timestamp: bool,
    domain: int | None,
    tf_topic: str,
    tf_static_topic: str,
) -> None:
    """Publish the transforms of the robot in FILE from its joint states, like ROS 2's robot_state_publisher.

    Pass xacro arguments as NAME:=VALUE. Arguments after --ros-args are passed to the node.

    Example: coframe robot arm.urdf.xacro reach:=2 --prefix robot1/
    """
    with run_until_interrupted():
        description = load(file, arguments=xacro_arguments(context.args)).text
        given = {
            "frame_prefix": prefix or None,
            "frame_prefix_keep": keep or None,
            "publish_frequency": frequency,
            "ignore_timestamp": ignore_timestamp or None,
        }
        # Omitted options do not override parameters set by -p and --params-file.
        parameters = {"robot_description": description} | {n: value for n, value in given.items() if value is not None}
        from coframe.nodes.robot_state_publisher import run  # noqa: PLC0415 - not needed if the file cannot be read
        from rclpy.parameter import Parameter  # noqa: PLC0415

        overrides = [Parameter(name, value=value) for name, value in parameters.items()]
        remaps = ["--ros-args", "-r", f"/tf:={tf_topic}", "-r", f"/tf_static:={tf_static_topic}"]
        with reported_node_errors():
            run(["coframe", *ros_arguments(context.args), *remaps], domain_id=domain, parameter_overrides=overrides)
