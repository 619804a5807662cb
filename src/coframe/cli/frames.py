# SPDX-License-Identifier: Apache-2.0
"""``coframe frames``: shows the transform trees with edge statistics, or writes a diagram, like view_frames."""

from __future__ import annotations

import importlib
import json
from typing import TYPE_CHECKING, Any

import click
from rich.console import Console
from rich.text import Text

from coframe._files.complete_files import write_complete
from coframe._process.optional_imports import importing_matplotlib, pip_install
from coframe.bags.namespaces import TransformChoice
from coframe.cli.declaration import PATH
from coframe.cli.frames_screen import tree_tables, watch
from coframe.cli.lifecycle import run_to_completion, run_until_interrupted
from coframe.cli.options import (
    PositiveDuration,
    domain_option,
    keep_option,
    namespace_option,
    optional_bag_argument,
    prefix_option,
    recorded_tf_static_topic_option,
    recorded_tf_topic_option,
)
from coframe.cli.output import fail, fail_to_write, printable, report_console, warn
from coframe.cli.progress import reading_progress
from coframe.cli.recordings import title_of
from coframe.cli.ros_arguments import NodeCommand, node_identity
from coframe.connection.listener_config import ListenerConfig
from coframe.doctor.recorded import observe_chosen
from coframe.tree_drawing import build_forest
from coframe.tree_drawing.graphviz import as_graphviz
from coframe.tree_drawing.labels import summary
from coframe.tree_drawing.mermaid import MAX_EDGES, as_markdown, as_mermaid
from coframe.tree_drawing.plain import as_data
from coframe.tree_drawing.svg import as_svg

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from coframe._sources.sources import Readable
    from coframe.tree_drawing import Forest

__all__ = ["frames"]


def _write_pdf(forest: Forest, title: str) -> bytes:
    from coframe.tree_drawing.pdf import as_pdf  # noqa: PLC0415 - needs an extra package

    return as_pdf(forest, title)


def _write_png(forest: Forest, title: str) -> bytes:
    with importing_matplotlib():
        from coframe.tree_drawing.png import as_png  # noqa: PLC0415 - needs an extra package

    return as_png(forest, title)


_FORMATS: dict[str, Callable[[Forest, str], str | bytes]] = {
    ".gv": as_graphviz,
    ".dot": as_graphviz,
    ".svg": as_svg,
    ".pdf": _write_pdf,
    ".png": _write_png,
    ".json": lambda forest, _: json.dumps(as_data(forest), indent=2) + "\n",
    ".mmd": as_mermaid,
    ".md": as_markdown,
}
# The package and the extra that a format needs.
_PACKAGES = {".pdf": ("pydyf", "pdf"), ".png": ("matplotlib", "plot")}


@click.command(cls=NodeCommand)
@optional_bag_argument
@click.option(
    "--output",
    "-o",
    metavar="FILE",
    type=PATH,
    multiple=True,
    help=f"Write a diagram or data: {', '.join(_FORMATS)}; repeatable.",
)
@click.option("--watch", "watching", is_flag=True, help="Update the trees continuously, and highlight changes.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON; times are in nanoseconds.")
@click.option(
    "--duration",
    metavar="DURATION",
    type=PositiveDuration,
    default="5s",
    help="Observation time; with --watch, the time window of the statistics.",
)
@namespace_option
@prefix_option
@keep_option
@domain_option
@recorded_tf_topic_option
@recorded_tf_static_topic_option
def frames(
    bag: Readable | None,
    output: tuple[Path, ...],
    watching: bool,
    as_json: bool,
    duration: PositiveDuration,
    namespace: str | None,
    prefix: str,
    keep: str,
    domain: int | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
) -> None:
    """Show the transform trees with the rate, delay and age of each edge, live or in the recording BAG.

    Arguments after --ros-args remap the node and the topics: -r __node:=NAME, -r /tf:=TOPIC.

    Example: coframe frames run.mcap -o frames.svg
    """
    files = [_check_output(path) for path in output]
    if watching and (files or bag is not None):
        fail(f"--watch cannot be combined with {'--output' if files else 'a recording'}", code=2)
    with run_until_interrupted() if watching else run_to_completion():
        if bag is not None:
            choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
            with reading_progress() as progress:
                observations = observe_chosen(bag, choice, progress=progress)
            forests = {name: build_forest(observation) for name, observation in observations.items()}
            for problem in dict.fromkeys(
                problem for observation in observations.values() for problem in observation.unread
            ):
                warn(problem)
            if not any(forest.frames for forest in forests.values()):
                fail(f"{bag} contains no transforms", "Use --tf-topic and --tf-static-topic to select other topics.")
            _write_or_print(forests, files, as_json, title_of(bag))
            return
        from coframe.doctor.live import LiveObserver  # noqa: PLC0415 - recordings need no middleware

        config = ListenerConfig.of(
            domain=domain,
            namespace=namespace,
            tf_topic=tf_topic,
            tf_static_topic=tf_static_topic,
            prefix=prefix,
            keep=keep,
        )
        with LiveObserver(config, window=duration, **node_identity("coframe_frames")) as observer:
            if watching:
                watch(observer, as_json)
                return
            if Console(stderr=True).is_terminal:
                click.echo(f"observing for {duration} ...", err=True)
            observer.listen(duration.seconds)
            observer.listen_for_statics()
            forest = build_forest(observer.observe())
        if not forest.frames:
            fail("no transforms received", "Check that a broadcaster is running in the same ROS domain.")
        _write_or_print({"": forest}, files, as_json, f"live on {config.tf_topic}")


def _check_output(path: Path) -> Path:
    """Return the path if its suffix is known and the package for its format is installed."""
    if path.suffix.lower() not in _FORMATS:
        fail(f"--output {path}: unknown suffix {path.suffix!r}. Suffixes: {', '.join(_FORMATS)}", code=2)
    suffix = path.suffix.lower()
    if suffix in _PACKAGES:
        _check_package(suffix)
    return path


def _check_package(suffix: str) -> None:
    package, extra = _PACKAGES[suffix]
    try:
        importlib.import_module(package)
    except ModuleNotFoundError:
        fail(
            f"{suffix[1:].upper()} needs the package {package}: {pip_install(extra)}",
            "Or write an .svg file, which needs no package.",
        )


def _write_or_print(forests: dict[str, Forest], files: list[Path], as_json: bool, title: str) -> None:
    """Write the files, or print the trees if there are none."""
    if files and len(forests) > 1:
        names = ", ".join(name or "/" for name in forests)
        fail(f"the recording has trees in several namespaces: {names}", "Choose one with --namespace.", code=2)
    for path in files:
        (forest,) = forests.values()
        _write(path, forest, title)
    if as_json:
        data: Any = {name: as_data(forest) for name, forest in forests.items()}
        print(json.dumps(data[""] if list(data) == [""] else {"namespaces": data}))
    elif not files:
        _print(forests)


def _write(path: Path, forest: Forest, title: str) -> None:
    content = _FORMATS[path.suffix.lower()](forest, title)
    try:
        write_complete(path, content if isinstance(content, bytes) else content.encode(errors="backslashreplace"))
    except OSError as error:
        fail_to_write(path, error)
    click.echo(f"{path}: {summary(forest)}", err=True)
    if path.suffix.lower() in {".mmd", ".md"} and len(forest.frames) > MAX_EDGES:
        warn(f"Mermaid draws at most {MAX_EDGES} edges, unless its option maxEdges is increased")


def _print(forests: dict[str, Forest]) -> None:
    console = report_console()
    for name, forest in forests.items():
        if len(forests) > 1:
            console.print(Text(printable(f"{name or '/'}:"), style="bold"))
        for part in tree_tables(forest):
            console.print(part)
