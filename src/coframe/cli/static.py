# SPDX-License-Identifier: Apache-2.0
"""``coframe static``: publishes a static transform, with both argument styles of static_transform_publisher."""

from __future__ import annotations

import secrets
import string
import threading
import time

import click
from click.exceptions import Exit

from coframe._output.escaping import display_name
from coframe.cli.declaration import PASS_ARGUMENTS_ON
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import checked_prefix
from coframe.cli.output import fail, log
from coframe.cli.ros_arguments import NodeCommand, NodeIdentity, node_identity
from coframe.cli.static_arguments import ArgumentError, StaticArguments, parse
from coframe.frame_names import renaming
from coframe.messages.conversions import to_transform_stamped
from coframe.wire.participant import Participant
from coframe.wire.system_clock import stamp_fault

__all__ = ["static"]

USAGE = """\
Usage: coframe static [OPTIONS] --frame-id FRAME --child-frame-id CHILD
       coframe static X Y Z YAW PITCH ROLL FRAME CHILD   (deprecated)
       coframe static X Y Z QX QY QZ QW FRAME CHILD      (deprecated)

  Publish a static transform, the pose of the frame CHILD relative to FRAME,
  until stopped, like ROS 2's static_transform_publisher.

  Example: coframe static --z 0.5 --frame-id base_link --child-frame-id lidar

Options:
  --frame-id FRAME         Parent frame.
  --child-frame-id CHILD   Child frame.
  --x X, --y Y, --z Z      Translation in meters. [default: 0]
  --roll ROLL, --pitch PITCH, --yaw YAW
                           Rotation as angles in radians about the fixed axes
                           x, y and z. [default: 0]
  --qx QX, --qy QY, --qz QZ, --qw QW
                           Rotation as a quaternion, instead of angles.
  --domain ID              ROS domain ID, 0 to 232. [default: $ROS_DOMAIN_ID,
                           or 0]
  --tf-static-topic TOPIC  Topic of the static transforms, e.g.
                           /robot1/tf_static. [default: /tf_static]
  --tf-topic TOPIC         Accepted for uniformity; has no effect.
  --prefix PREFIX          Prefix for all frame names, including the slash, e.g.
                           robot1/.
  --keep FRAMES            Shared frames that are not prefixed, e.g. map,world.
  --ros-args -r __node:=NAME -r __ns:=/NAMESPACE -r /tf_static:=TOPIC
                           Rename the node and the topic.
  --wire [dds|zenoh]       Middleware to use. [default: $COFRAME_WIRE, or DDS]
  --help                   Show this message and exit.
"""


# The command parses its arguments itself, because numbers may be negative.
@click.command(cls=NodeCommand, add_help_option=False, context_settings=PASS_ARGUMENTS_ON)
@click.pass_context
def static(context: click.Context) -> None:
    """Publish a static transform until stopped, like ROS 2's static_transform_publisher.

    Example: coframe static --z 0.5 --frame-id base_link --child-frame-id lidar
    """
    if not context.args or {"-h", "--help"} & set(context.args):
        click.echo(USAGE, nl=False)
        raise Exit(0 if context.args else 2)
    suffix = "".join(secrets.choice(string.ascii_letters) for _ in range(16))
    identity = node_identity(f"static_transform_publisher_{suffix}")
    node = identity["node_name"]
    try:
        arguments = parse(context.args)
    except ArgumentError as error:
        log("ERROR", node, f"error parsing command line arguments: {error}")
        click.echo(USAGE, nl=False)
        raise Exit(1) from None
    if arguments.old_style:
        log("WARN", node, "Old-style arguments are deprecated; see --help for new-style arguments")
    if arguments.frame_id == arguments.child_frame_id:
        names = f"from '{display_name(arguments.frame_id)}' to '{display_name(arguments.child_frame_id)}'"
        fail(
            f"cannot publish static transform {names}, exiting",
            "A frame cannot be its own parent: give two different frames.",
        )
    _add_prefix(arguments)
    with run_until_interrupted():
        _publish_until_stopped(arguments, identity)


def _add_prefix(arguments: StaticArguments) -> None:
    checked_prefix(arguments.prefix)
    names = renaming(arguments.prefix, arguments.keep)
    if names is not None:
        arguments.frame_id, arguments.child_frame_id = names(arguments.frame_id), names(arguments.child_frame_id)


def _publish_until_stopped(arguments: StaticArguments, identity: NodeIdentity) -> None:
    if (fault := stamp_fault()) is not None:
        raise fault
    participant = Participant.get(arguments.domain)
    try:
        node = participant.add_node(identity["node_namespace"], identity["node_name"])
        writer = participant.static_broadcaster(node, arguments.tf_static_topic)
        names = (arguments.frame_id, arguments.child_frame_id)
        writer.send([to_transform_stamped(*names, arguments.transform, time.time_ns())])
        log("INFO", node.name, _announcement_text(arguments))
        threading.Event().wait()
    finally:
        participant.close()


def _announcement_text(arguments: StaticArguments) -> str:
    values = [f"'{value:f}'" for value in arguments.transform.values]
    parent, child = display_name(arguments.frame_id), display_name(arguments.child_frame_id)
    return (
        f"Spinning until stopped - publishing transform\ntranslation: ({', '.join(values[:3])})\n"
        f"rotation: ({', '.join(values[3:])})\nfrom '{parent}' to '{child}'"
    )
