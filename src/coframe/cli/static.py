"""``coframe static``: static_transform_publisher, with both argument styles."""

from __future__ import annotations

import secrets
import string
import threading
import time

import typer

from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import checked_prefix
from coframe.cli.output import fail, log
from coframe.cli.static_arguments import ArgumentError, StaticArguments, parse
from coframe.frame_names import renaming
from coframe.messages.conversions import to_transform_stamped
from coframe.wire import Participant

__all__ = ["static"]

USAGE = """\
Usage: coframe static [--x X] [--y Y] [--z Z] [--qx QX --qy QY --qz QZ --qw QW | --roll R --pitch P --yaw Y]
                      --frame-id FRAME --child-frame-id CHILD [--domain ID] [--tf-static-topic TOPIC]
                      [--prefix robot1/] [--keep map,world]   (--tf-topic is taken, too: nothing is sent there)
       coframe static X Y Z YAW PITCH ROLL FRAME CHILD      (the old order)
       coframe static X Y Z QX QY QZ QW FRAME CHILD         (the old order)

Publishes a static transform until stopped: where CHILD is, seen from FRAME. Metres and radians.

Example: coframe static --z 0.5 --frame-id base_link --child-frame-id lidar_link
"""


def static(context: typer.Context) -> None:
    """Publish a transform that never changes, as ROS 2's static_transform_publisher does.

    Example: coframe static --z 0.5 --frame-id base_link --child-frame-id lidar_link
    """
    if not context.args or {"-h", "--help"} & set(context.args):
        typer.echo(USAGE, nl=False)
        raise typer.Exit(0 if context.args else 2)
    node = "static_transform_publisher_" + "".join(secrets.choice(string.ascii_letters) for _ in range(16))
    try:
        arguments = parse(context.args)
    except ArgumentError as error:
        log("ERROR", node, f"error parsing command line arguments: {error}")
        typer.echo(USAGE, nl=False)
        raise typer.Exit(1) from None
    if arguments.old_style:
        log("WARN", node, "Old-style arguments are deprecated; see --help for new-style arguments")
    if arguments.frame_id == arguments.child_frame_id:
        names = f"from '{arguments.frame_id}' to '{arguments.child_frame_id}'"
        fail(f"cannot publish static transform {names}, exiting", "A frame cannot be told in itself.")
    _rename(arguments)
    with run_until_interrupted():
        _publish_until_stopped(arguments, node)


def _rename(arguments: StaticArguments) -> None:
    checked_prefix(arguments.prefix)
    names = renaming(arguments.prefix, arguments.keep)
    if names is not None:
        arguments.frame_id, arguments.child_frame_id = names(arguments.frame_id), names(arguments.child_frame_id)


def _publish_until_stopped(arguments: StaticArguments, node: str) -> None:
    participant = Participant.get(arguments.domain)
    try:
        writer = participant.static_broadcaster(participant.add_node("/", node), arguments.tf_static_topic)
        names = (arguments.frame_id, arguments.child_frame_id)
        writer.send([to_transform_stamped(*names, arguments.transform, time.time_ns())])
        log("INFO", node, _announcement(arguments))
        threading.Event().wait()
    finally:
        participant.close()


def _announcement(arguments: StaticArguments) -> str:
    values = [f"'{value:f}'" for value in arguments.transform.values]
    return (
        f"Spinning until stopped - publishing transform\ntranslation: ({', '.join(values[:3])})\n"
        f"rotation: ({', '.join(values[3:])})\nfrom '{arguments.frame_id}' to '{arguments.child_frame_id}'"
    )
