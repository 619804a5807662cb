"""``coframe why``: is there a transform between two frames, from which links; if not, which is missing, late or early.

The arguments are those of ``coframe lookup``: who gets an error there changes one word of the line.
"""

from __future__ import annotations

import json
import time
from collections import deque
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple, NoReturn

import typer
from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

import coframe
from coframe.bags import parse_instant
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
from coframe.cli.recordings import open_recording, parse_time
from coframe.doctor import Observation, diagnose
from coframe.doctor.recorded import collecting
from coframe.doctor.rendering.plain import as_data
from coframe.doctor.rendering.text import headline
from coframe.explanation.drawing import remark, verdict
from coframe.frame_names import renaming
from coframe.messages import find
from coframe.time import SECOND, stamp_ns

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from coframe import Connection
    from coframe.bags import Recording
    from coframe.doctor import Finding, Report
    from coframe.doctor.collector import Collector
    from coframe.explanation import Explanation, Link

__all__ = ["why"]

_NAMES = "[BAG] TARGET SOURCE"
_TF_TYPE = "tf2_msgs/msg/TFMessage"
_WHEN = "A stamp, 10s (from the start), -0.5s (from the end, or from now), ISO time, start, end; live also now."
_ASCII = str.maketrans("├└│─", "+`|-")
_STYLES = {"error": "bold red", "warning": "yellow", "note": "cyan"}


class _Names(NamedTuple):
    """What frames are called."""

    prefix: str
    keep: str


class _Live(NamedTuple):
    """Where to listen."""

    domain: int | None
    tf_topic: str
    tf_static_topic: str
    names: _Names


class _Answer(NamedTuple):
    """What is told: the explanation, what the doctor finds about its links, and where else there are transforms."""

    found: Explanation
    reports: list[Report]
    notes: list[str]


def why(
    names: Annotated[
        list[str] | None,
        typer.Argument(
            metavar=_NAMES, help="Two frames, as for lookup; without a recording it listens.", show_default=False
        ),
    ] = None,
    at: Annotated[
        str | None, typer.Option("--at", "-t", help=f"When: {_WHEN}", show_default="the latest possible")
    ] = None,
    duration: Annotated[str, typer.Option("--duration", "--timeout", help="How long to listen.")] = "2s",
    watch: Annotated[bool, typer.Option("--watch", help="Listen on, with an answer a second.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="One line of JSON an answer; times in nanoseconds.")] = False,
    namespace: NamespaceOption = None,
    domain: DomainOption = None,
    tf_topic: RecordedTfTopicOption = None,
    tf_static_topic: RecordedTfStaticTopicOption = None,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
) -> None:
    """Tell why SOURCE can be seen from TARGET, or why not: by which links, how old, from whom, and what to change.

    Exit code 0: there is a transform; 1: there is none.

    Example: coframe why base_link camera_link --at now
    """
    if names is None or len(names) not in {2, 3}:
        fail("give TARGET and SOURCE, with a recording in front of them or without", code=2)
    *bags, target, source = names
    if not bags:
        reject_namespace_of_live_graph(namespace)
        if Path(target).exists() and not {"/", "."}.isdisjoint(target):
            fail(f"{target} is a file or a folder: give TARGET and SOURCE behind the recording", code=2)
    if watch and bags:
        fail("--watch and a recording exclude each other", code=2)
    patience = positive_duration("--duration", duration)
    renamed = _Names(prefix, keep)
    place = _Live(domain, tf_topic or TF_TOPIC, tf_static_topic or TF_STATIC_TOPIC, renamed)
    with run_until_interrupted() if watch else run_to_completion():
        if bags:
            topics = {"tf_topic": tf_topic, "tf_static_topic": tf_static_topic}
            answer = _recorded(Path(bags[0]), target, source, at, namespace, topics, renamed)
        elif watch:
            _watch(place, target, source, at, patience, as_json=as_json)
        else:
            answer = _heard(place, target, source, at, patience)
        _print(answer, as_json=as_json)
        raise typer.Exit(0 if answer.found.possible else 1)


def _recorded(
    bag: Path, target: str, source: str, at: str | None, namespace: str | None, topics: dict[str, Any], names: _Names
) -> _Answer:
    collectors: dict[str, Collector] = {}
    heard = collecting(collectors, renaming(**names._asdict()), recorded_tf_topics(**topics))
    with open_recording(bag, namespace, **topics, **names._asdict(), heard=heard) as recording:
        found = recording.buffer.why(target, source, None if at is None else parse_time("--at", at, recording))
        seen = [
            Observation(live=False, start=recording.start, end=recording.end, transforms=collectors[name].transforms())
            for name in sorted(collectors)
        ]
        return _Answer(found, _concerning(found, seen), list(_other_namespaces(found, recording)))


def _heard(place: _Live, target: str, source: str, at: str | None, window: int) -> _Answer:
    from coframe.doctor.live import LiveObserver  # noqa: PLC0415 - recordings need no DDS

    with (
        _connection(place) as ros,
        LiveObserver(
            place.domain,
            tf_topic=place.tf_topic,
            tf_static_topic=place.tf_static_topic,
            node_name="coframe_why_doctor",
            **place.names._asdict(),
        ) as listening,
    ):
        if Console(stderr=True).is_terminal:
            typer.echo(f"listening for {window / SECOND:g} s ...", err=True)
        listening.listen(window / SECOND)
        seen = listening.observe()
        clock = int(seen.clock.stamp[-1]) if seen.clock is not None else None
        found = ros.buffer.why(target, source, _instant(at, clock, window), now=clock)
        return _Answer(found, _concerning(found, [seen]), list(_other_topics(found, ros, place)))


def _watch(place: _Live, target: str, source: str, at: str | None, window: int, *, as_json: bool) -> NoReturn:
    """An answer a second, without the doctor; until Ctrl-C."""
    from coframe.wire import QoS  # noqa: PLC0415 - recordings need no DDS

    with _connection(place) as ros, Live(console=Console(highlight=False), auto_refresh=False) as live:
        ticks: deque[Any] = deque(maxlen=1)
        ros.subscribe("/clock", find("rosgraph_msgs/msg/Clock"), ticks.append, QoS(depth=1, reliable=False))
        while True:
            clock = stamp_ns(ticks[0].clock) if ticks else None
            answer = _Answer(ros.buffer.why(target, source, _instant(at, clock, window), now=clock), [], [])
            if as_json:
                print(json.dumps(_data(answer)), flush=True)
            else:
                live.update(Group(*_texts(answer, live.console)), refresh=True)
            time.sleep(1.0)


def _connection(place: _Live) -> Connection:
    return coframe.connect(
        "coframe_why",
        domain=place.domain,
        tf_topic=place.tf_topic,
        tf_static_topic=place.tf_static_topic,
        **place.names._asdict(),
    )


def _instant(at: str | None, clock: int | None, window: int) -> int | None:
    """A point in time while listening, which ends now."""
    if at is None:
        return None
    now = time.time_ns() if clock is None else clock
    try:
        return now if at.strip() == "now" else parse_instant(at, (now - window, now))
    except ValueError as error:
        fail(f"--at: {error}", code=2)


def _concerning(found: Explanation, seen: Iterable[Observation]) -> list[Report]:
    """What the doctor finds about the links; where a link or a frame is missing, also about all frames or these."""
    links = {(link.parent, link.child) for link in found.links}
    frames = {found.target, found.source, *found.frames}
    incomplete = found.roots is not None or bool(found.unknown)

    def concerns(finding: Finding) -> bool:
        if finding.edge is not None:
            return finding.edge in links
        return incomplete and (not finding.frames or not frames.isdisjoint(finding.frames))

    reports = map(diagnose, seen)
    return [
        report._replace(findings=[one.explaining(()) for one in report.every_finding() if concerns(one)], sensors=[])
        for report in reports
    ]


def _other_namespaces(found: Explanation, recording: Recording) -> Iterator[str]:
    for frame in found.unknown:
        for name, buffer in recording.buffers.items():
            if frame in buffer:
                yield f"{frame!r} is told of on {name}/tf: coframe why ... --namespace {name or '/'}"


def _other_topics(found: Explanation, ros: Connection, place: _Live) -> Iterator[str]:
    if found.possible:
        return
    for topic, publishers in sorted(ros.participant.published().items()):
        types = {endpoint.ros_type for endpoint in publishers.values()}
        if _TF_TYPE in types and topic not in {place.tf_topic, place.tf_static_topic}:
            option = "--tf-static-topic" if topic.endswith("static") else "--tf-topic"
            yield f"there are transforms on {topic}, too: coframe why ... {option} {topic}"


def _print(answer: _Answer, *, as_json: bool) -> None:
    if as_json:
        print(json.dumps(_data(answer)))
        return
    console = Console(highlight=False, soft_wrap=True)
    for text in _texts(answer, console):
        console.print(text)


def _texts(answer: _Answer, console: Console) -> list[Text]:
    first, *rest = str(answer.found).split("\n")
    lines = [("green" if answer.found.possible else "bold red", first), *(("", line) for line in rest)]
    for report in answer.reports:
        for finding in report.findings:
            lines += [(_STYLES[str(finding.severity)], headline(finding)), ("", f"      do:  {finding.fix}")]
    lines += [("", note) for note in answer.notes]
    shown = [(style, printable(line)) for style, line in lines]
    if console.options.ascii_only:
        shown = [(style, line.translate(_ASCII)) for style, line in shown]
    return [Text(line, style=style) for style, line in shown]


def _data(answer: _Answer) -> dict[str, Any]:
    found = answer.found
    return {
        "possible": found.possible,
        "target": found.target,
        "source": found.source,
        "stamp_ns": found.stamp or None,
        "answered_ns": found.answered,
        "code": found.code or None,
        "verdict": verdict(found),
        "text": found.text or None,
        "hint": found.hint or None,
        "frames": list(found.frames),
        "links": [_link(found, link) for link in found.links],
        "unknown": list(found.unknown),
        "roots": found.roots,
        "missing": found.missing and found.missing[:2],
        "limit": found.limit,
        "span_ns": found.span,
        "possible_at_ns": found.possible_at,
        "findings": [finding for report in answer.reports for finding in as_data(report)["findings"]],
        "notes": answer.notes,
    }


def _link(found: Explanation, link: Link) -> dict[str, Any]:
    times = {"by", "oldest", "newest", "age", "gap"}
    named = {f"{name}_ns" if name in times else name: value for name, value in link._asdict().items()}
    return {**named, "remark": remark(found, link)}
