"""``coframe robot``: robot_state_publisher for a file."""

from __future__ import annotations

from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import Annotated

import typer

from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.node_arguments import reported_node_errors, xacro_arguments
from coframe.cli.options import (
    TF_STATIC_TOPIC,
    TF_TOPIC,
    DomainOption,
    KeepOption,
    PrefixOption,
    TfStaticTopicOption,
    TfTopicOption,
)
from coframe.robots import load

__all__ = ["robot"]


def robot(
    context: typer.Context,
    file: Annotated[Path, typer.Argument(help="URDF, or xacro.")],
    prefix: PrefixOption = "",
    keep: KeepOption = "",
    frequency: Annotated[
        float | None,
        typer.Option(
            "--frequency",
            "-f",
            min=0.0,
            max=1000.0,
            help="How often at most a joint is told of, in Hz.",
            show_default="20.0",
        ),
    ] = None,
    ignore_timestamp: Annotated[
        bool, typer.Option("--ignore-timestamp", help="Tell of every joint state, however close together.")
    ] = False,
    domain: DomainOption = None,
    tf_topic: TfTopicOption = TF_TOPIC,
    tf_static_topic: TfStaticTopicOption = TF_STATIC_TOPIC,
) -> None:
    """Publish the transforms of the robot in FILE from its joint states, as robot_state_publisher does.

    NAME:=VALUE gives a xacro file its arguments; what follows --ros-args is the node's.

    Example: coframe robot arm.urdf.xacro --prefix robot1/ --ros-args -r joint_states:=arm/joint_states
    """
    with run_until_interrupted():
        description = load(file, arguments=xacro_arguments(context.args)).text
        given = {
            "frame_prefix": prefix or None,
            "frame_prefix_keep": keep or None,
            "publish_frequency": frequency,
            "ignore_timestamp": ignore_timestamp or None,
        }
        # What was not given is left to the node's own parameters, of -p and --params-file.
        parameters = {"robot_description": description} | {n: value for n, value in given.items() if value is not None}
        from rclpy.parameter import Parameter  # noqa: PLC0415 - a file that cannot be read needs no graph
        from robot_state_publisher import run  # noqa: PLC0415

        overrides = [Parameter(name, value=value) for name, value in parameters.items()]
        remaps = ["--ros-args", "-r", f"/tf:={tf_topic}", "-r", f"/tf_static:={tf_static_topic}"]
        with reported_node_errors():
            run(["coframe", *context.args, *remaps], domain_id=domain, parameter_overrides=overrides)
