"""``coframe frames``: the transform trees with their figures, in the terminal or as a picture (view_frames)."""

from __future__ import annotations

import json
from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from rich.text import Text

from coframe.cli.frames_screen import tree, watch
from coframe.cli.lifecycle import run_to_completion, run_until_interrupted
from coframe.cli.options import (
    TF_STATIC_TOPIC,
    TF_TOPIC,
    DomainOption,
    KeepOption,
    NamespaceOption,
    PrefixOption,
    RecordedTfStaticTopicOption,
    RecordedTfTopicOption,
    positive_duration,
    recorded_tf_topics,
    reject_namespace_of_live_graph,
)
from coframe.cli.output import fail, printable
from coframe.cli.progress import reading_progress
from coframe.doctor import observe_recording
from coframe.time import SECOND
from coframe.tree_drawing import grow
from coframe.tree_drawing.graphviz import as_graphviz
from coframe.tree_drawing.labels import summary
from coframe.tree_drawing.mermaid import MOST_LINKS, as_markdown, as_mermaid
from coframe.tree_drawing.plain import as_data
from coframe.tree_drawing.svg import as_svg

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.tree_drawing import Forest

__all__ = ["frames"]


def _pdf(forest: Forest, title: str) -> bytes:
    from coframe.tree_drawing.pdf import as_pdf  # noqa: PLC0415 - its library is an extra

    return as_pdf(forest, title)


_FORMATS: dict[str, Callable[[Forest, str], str | bytes]] = {
    ".gv": as_graphviz,
    ".dot": as_graphviz,
    ".svg": as_svg,
    ".pdf": _pdf,
    ".json": lambda forest, _: json.dumps(as_data(forest), indent=2) + "\n",
    ".mmd": as_mermaid,
    ".md": as_markdown,
}


def frames(
    bag: Annotated[
        Path | None, typer.Argument(metavar="[BAG]", help="A recording; without one it listens.", show_default=False)
    ] = None,
    output: Annotated[
        list[Path] | None,
        typer.Option("--output", "-o", metavar="FILE", help=f"Write a picture: {', '.join(_FORMATS)}; again for more."),
    ] = None,
    watching: Annotated[bool, typer.Option("--watch", help="Listen on; what has changed is highlighted.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="JSON on standard output; times in nanoseconds.")] = False,
    duration: Annotated[str, typer.Option(help="How long to listen; the window of --watch.")] = "5s",
    namespace: NamespaceOption = None,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
    domain: DomainOption = None,
    tf_topic: RecordedTfTopicOption = None,
    tf_static_topic: RecordedTfStaticTopicOption = None,
) -> None:
    """Show the transform trees with the figures of each link: live, or in the recording BAG.

    Example: coframe frames run.mcap -o frames.svg
    """
    files = [_known(path) for path in output or []]
    window = positive_duration("--duration", duration)
    if watching and (files or bag is not None):
        fail("--watch excludes a recording and --output", code=2)
    names: dict[str, Any] = {"prefix": prefix, "keep": keep}
    if bag is None:
        reject_namespace_of_live_graph(namespace)
    with run_until_interrupted() if watching else run_to_completion():
        if bag is not None:
            topics = recorded_tf_topics(tf_topic, tf_static_topic)
            with reading_progress() as progress:
                seen = observe_recording(bag, namespace=namespace, tf_topics=topics, progress=progress, **names)
            forests = {name: grow(one) for name, one in seen.items()}
            for problem in dict.fromkeys(problem for one in seen.values() for problem in one.unread):
                typer.echo(f"coframe: {printable(problem)}", err=True)
            _finish(forests, files, as_json, bag.resolve().name)
            return
        from coframe.doctor.live import LiveObserver  # noqa: PLC0415 - recordings need no DDS

        names |= {"tf_topic": tf_topic or TF_TOPIC, "tf_static_topic": tf_static_topic or TF_STATIC_TOPIC}
        with LiveObserver(domain, window=window, node_name="coframe_frames", **names) as listening:
            if watching:
                watch(listening, as_json)
                return
            if Console(stderr=True).is_terminal:
                typer.echo(f"listening for {duration} ...", err=True)
            listening.listen(window / SECOND)
            seen_live = grow(listening.observe())
        _finish({"": seen_live}, files, as_json, f"live on {names['tf_topic']}")


def _known(path: Path) -> Path:
    """A file that can be written, as far as its name and the installed packages tell."""
    if path.suffix.lower() not in _FORMATS:
        fail(f"{path} names no known format", f"Let it end in {', '.join(_FORMATS)}.", code=2)
    if path.suffix.lower() == ".pdf":
        try:
            import pydyf  # noqa: F401, PLC0415 - an extra
        except ModuleNotFoundError:
            fail("PDF needs the package pydyf: pip install 'coframe[pdf]'", "An .svg needs nothing.")
    return path


def _finish(forests: dict[str, Forest], files: list[Path], as_json: bool, title: str) -> None:
    """Writes the files, and prints what is left to print."""
    if not any(forest.frames for forest in forests.values()):
        fail("no transforms came", "Is a broadcaster running, in the same ROS domain?")
    if files and len(forests) > 1:
        names = ", ".join(name or "/" for name in forests)
        fail("each of several namespaces has trees of its own", f"Choose one by --namespace: {names}", code=2)
    for path in files:
        (forest,) = forests.values()
        _write(path, forest, title)
    if as_json:
        data: Any = {name: as_data(forest) for name, forest in forests.items()}
        print(json.dumps(data[""] if list(data) == [""] else {"namespaces": data}))
    elif not files:
        _print(forests)


def _write(path: Path, forest: Forest, title: str) -> None:
    picture = _FORMATS[path.suffix.lower()](forest, title)
    try:
        path.write_bytes(picture if isinstance(picture, bytes) else picture.encode(errors="backslashreplace"))
    except OSError as error:
        fail(f"{path} cannot be written: {error.strerror}")
    typer.echo(f"{path}: {summary(forest)}", err=True)
    if path.suffix.lower() in {".mmd", ".md"} and len(forest.frames) > MOST_LINKS:
        typer.echo(f"coframe: Mermaid draws no more than {MOST_LINKS} links unless its maxEdges is raised", err=True)


def _print(forests: dict[str, Forest]) -> None:
    # What is written to a file or another program is not cut to the width of a terminal that is not there.
    console = Console(highlight=False)
    if not console.is_terminal:
        console = Console(highlight=False, width=200)
    for name, forest in forests.items():
        if len(forests) > 1:
            console.print(Text(printable(f"{name or '/'}:"), style="bold"))
        console.print(tree(forest))
