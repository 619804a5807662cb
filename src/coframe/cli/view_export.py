# SPDX-License-Identifier: Apache-2.0
"""``coframe view BAG -o FILE``: a replay of a recording as one HTML file, without a browser."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from coframe._files.complete_files import write_complete
from coframe.bags.namespaces import TransformChoice
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.output import fail_to_write
from coframe.cli.progress import task_progress
from coframe.cli.recordings import check_has_transforms, open_recording, parse_time
from coframe.robots import load
from coframe.viewer.replay.export import export_replay
from coframe.viewer.robots.robot_message import make_mesh_table
from coframe.viewer.rviz.config import RvizConfig
from coframe.viewer.sources.recorded import RecordedSource

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from coframe._sources.sources import Readable
    from coframe.bags.namespaces import TransformChoice

__all__ = ["write_replay"]


def write_replay(
    bag: Readable,
    output: Path,
    choice: TransformChoice,
    *,
    rviz: Path | None,
    fixed: str,
    robot: Path | None,
    robot_arguments: Mapping[str, str],
    mesh_roots: Sequence[Path],
    start: str | None,
    stop: str | None,
    rate: float | None,
) -> None:
    """Write the replay atomically."""
    with run_to_completion():
        config = None if rviz is None else RvizConfig.load(rviz)
        description = None if robot is None else load(robot, arguments=robot_arguments, packages=list(mesh_roots))
        meshes = make_mesh_table(robot, mesh_roots)
        with open_recording(bag, choice) as recording:
            check_has_transforms(recording)
            source = RecordedSource(recording)
            with task_progress() as progress:
                page = export_replay(
                    source,
                    meshes,
                    rviz=config,
                    robot=description,
                    fixed=fixed,
                    first=None if start is None else parse_time("--start", start, recording),
                    last=None if stop is None else parse_time("--stop", stop, recording),
                    rate=rate,
                    progress=progress,
                )
        _write(output, page)
        click.echo(f"{output}: {len(page) / 1e6:.1f} MB; open it in any browser", err=True)


def _write(output: Path, page: bytes) -> None:
    try:
        write_complete(output, page)
    except OSError as error:
        fail_to_write(output, error)
