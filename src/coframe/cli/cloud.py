# SPDX-License-Identifier: Apache-2.0
"""``coframe cloud``: writes the point clouds, scans or depth images of a recording, transformed into one frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, cast

import click

from coframe._output.formatting import count
from coframe.bags import Clouds, write_clouds
from coframe.bags.namespaces import TransformChoice
from coframe.cli.completion import complete_frames
from coframe.cli.declaration import PATH, Command, argument
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    PositiveDuration,
    bag_argument,
    max_gap_option,
    namespace_option,
    on_gap_option,
    recorded_listener_options,
    validity_option,
)
from coframe.cli.output import fail, fail_to_write, printable, warn
from coframe.cli.progress import item_progress
from coframe.cli.recordings import open_recording, parse_time

if TYPE_CHECKING:
    from pathlib import Path

    from coframe._sources.sources import Readable
    from coframe.bags import Recording
    from coframe.buffer.gaps import OnGap

__all__ = ["cloud"]


@click.command(cls=Command)
@bag_argument
@argument("topic", metavar="TOPIC", help="Topic of type PointCloud2 or LaserScan, or a depth image.")
@click.option(
    "--frame",
    metavar="FRAME",
    required=True,
    shell_complete=complete_frames,
    help="Frame in which the points are expressed.",
)
@click.option(
    "--output",
    "-o",
    metavar="FILE|FOLDER",
    type=PATH,
    required=True,
    help="For one cloud: .ply, .pcd, .npz or .npy. For one cloud per message: a folder or a new .mcap file.",
)
@click.option("--format", "-f", "format_", metavar="FORMAT", help="Format of the files in a folder. [default: ply]")
@click.option("--at", "-t", metavar="TIME", help="Use only the message at this time.")
@click.option("--start", metavar="TIME", help="Start time, in the same format as `lookup --at`.")
@click.option("--stop", metavar="TIME", help="End time, in the same format as --start.")
@click.option(
    "--deskew",
    metavar="MODE",
    default="auto",
    help="auto: transform each point at its own time if the cloud contains times; off: use the stamp of the message.",
)
@click.option(
    "--point-times",
    metavar="FIELD[:UNIT]",
    help="Field with the time of each point and its unit: s, ms, us or ns. [default: detected]",
)
@click.option("--fixed", metavar="FRAME", help="Frame that does not move during a sweep; required if --frame moves.")
@click.option(
    "--fields", metavar="FIELDS", help="Fields to keep in addition to x,y,z, e.g. intensity,ring. [default: all]"
)
@click.option("--color", metavar="IMAGE_TOPIC", help="Color the points that the camera of these images sees.")
@click.option(
    "--color-info",
    metavar="TOPIC",
    help="CameraInfo of the images of --color. [default: the camera_info topic next to them]",
)
@click.option(
    "--depth-info", metavar="TOPIC", help="CameraInfo of depth images. [default: the camera_info topic next to them]"
)
@click.option("--voxel", metavar="METERS", type=float, help="Keep one point per cube with this edge length, in meters.")
@click.option(
    "--float64", is_flag=True, help="Also write the coordinates in PCD and MCAP files as float64. [default: float32]"
)
@max_gap_option
@on_gap_option
@validity_option
@namespace_option
@recorded_listener_options
def cloud(
    bag: Readable,
    topic: str,
    frame: str,
    output: Path,
    format_: str | None,
    at: str | None,
    start: str | None,
    stop: str | None,
    deskew: str,
    point_times: str | None,
    fixed: str | None,
    fields: str | None,
    color: str | None,
    color_info: str | None,
    depth_info: str | None,
    voxel: float | None,
    float64: bool,
    max_gap: PositiveDuration | None,
    on_gap: str,
    validity: bool,
    namespace: str | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
) -> None:
    """Write the clouds, scans or depth images on TOPIC in the recording BAG, transformed into FRAME at their own times.

    Example: coframe cloud run.mcap /points --frame map --voxel 0.05 -o map.ply
    """
    if deskew not in {"auto", "off"}:
        fail(f"--deskew must be auto or off, not {deskew!r}", code=2)
    if voxel is not None and not voxel > 0:
        fail(f"--voxel must be greater than 0 m, not {voxel:g}", code=2)
    if at is not None and (start is not None or stop is not None):
        fail("--at cannot be combined with --start or --stop", code=2)
    choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
    with run_to_completion(), open_recording(bag, choice) as recording:
        times = {"at": at, "start": start, "stop": stop}
        try:
            clouds = Clouds(
                recording,
                topic,
                frame,
                **_parse_times(recording, times),
                deskew=cast("Literal['auto', 'off']", deskew),
                point_times=point_times,
                fixed=fixed,
                fields=None if fields is None else [name for name in fields.split(",") if name],
                max_gap=max_gap,
                on_gap=cast("OnGap", on_gap),
                validity=validity,
                color=color,
                color_info=color_info,
                depth_info=depth_info,
            )
        except ValueError as error:
            if hasattr(error, "hint"):
                raise
            fail(str(error), code=2)
        try:
            points = _write(clouds, output, format_, voxel, float64=float64)
        except ValueError as error:
            if hasattr(error, "hint"):
                raise
            fail(str(error), "Choose the fields to keep with --fields." if "fields" in str(error) else "", code=2)
        except OSError as error:
            fail_to_write(output, error)
        _print_notes(clouds)
        print(printable(f"{output}: {_describe_counts(clouds, points)}, in frame {frame!r}"))


def _parse_times(recording: Recording, times: dict[str, str | None]) -> dict[str, Any]:
    return {name: None if text is None else parse_time(f"--{name}", text, recording) for name, text in times.items()}


def _write(clouds: Clouds, output: Path, format_: str | None, voxel: float | None, *, float64: bool) -> int:
    with item_progress("transforming", clouds.total) as show:
        return write_clouds(clouds, output, format_=format_, voxel=voxel, float64=float64, progress=show)


def _describe_counts(clouds: Clouds, points: int) -> str:
    """Return a summary of the numbers of written, deskewed, thinned and omitted points and messages."""
    parts = [f"{clouds.deskewed} deskewed"] if clouds.deskewed else []
    if clouds.colored:
        parts.append(f"{count(clouds.colored, 'point')} colored")
    if points < clouds.points:
        parts.append(f"thinned from {count(clouds.points, 'point')}")
    if omitted := sum(clouds.skipped.values()):
        parts.append(f"{omitted} omitted")
    notes = f" ({', '.join(parts)})" if parts else ""
    return f"{count(points, 'point')} of {count(clouds.messages, 'message')}{notes}"


def _print_notes(clouds: Clouds) -> None:
    """Print how the times of points were interpreted, and which messages and points were omitted and why."""
    for how, number in clouds.times_read.items():
        warn(f"deskewed the points of {count(number, 'message')} by their own times: {how}")
    for fixed, number in clouds.fixed_frames.items():
        if fixed != clouds.frame and not clouds.fixed_given:
            warn(
                f"deskewed the points of {count(number, 'message')} in the frame {fixed!r}, because {clouds.frame!r} "
                f"moves with the sensor; as with --fixed {fixed}"
            )
    for child, number in clouds.gaps.items():
        warn(
            f"{count(number, 'message')} in gaps without a sample of {child!r} were interpolated; --max-gap omits them"
        )
    for doubt, number in clouds.doubts.items():
        warn(f"{count(number, 'message')}: {doubt}. Check the unit, and set it with --point-times FIELD:UNIT")
    for reason, number in clouds.not_deskewed.items():
        warn(f"did not deskew the points of {count(number, 'message')}: {reason} (--point-times, --deskew off)")
    for reason, number in clouds.not_colored.items():
        warn(f"did not color the points of {count(number, 'message')}: {reason}")
    for reason, number in clouds.skipped.items():
        warn(f"omitted {count(number, 'message')} of {clouds.topic}: {reason}")
    for reason, number in clouds.points_skipped.items():
        warn(f"omitted {count(number, 'point')} of {clouds.topic}: they {reason}")
