# SPDX-License-Identifier: Apache-2.0
"""``coframe why``: explains why a transform between two frames is or is not available.

The arguments are the same as for ``coframe lookup``, so that a user who gets an error there only has to change the
command.
"""

from __future__ import annotations

import json
import shlex
import time
from collections import deque
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn

import click
from click.exceptions import Exit
from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

from coframe._output.formatting import join_names
from coframe.bags import parse_time_point
from coframe.bags.namespaces import TransformChoice
from coframe.buffer.explanation.drawing import edge_remark, verdict_text
from coframe.cli.completion import complete_frames
from coframe.cli.declaration import Command, argument
from coframe.cli.lifecycle import run_to_completion, run_until_interrupted
from coframe.cli.options import (
    TIMES,
    PositiveDuration,
    domain_option,
    namespace_option,
    recorded_listener_options,
)
from coframe.cli.output import awaited_statics_text, fail, for_command_line, one_line
from coframe.cli.recordings import check_has_transforms, open_recording, parse_lookup_time
from coframe.connection.connection import Connection
from coframe.connection.listener_config import ListenerConfig
from coframe.doctor import Observation, diagnose
from coframe.doctor.recorded import collecting_callback
from coframe.doctor.rendering.plain import as_data
from coframe.doctor.rendering.text import headline
from coframe.messages import find
from coframe.time import SECOND, stamp_ns
from coframe.type_names import TF_MESSAGE

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from coframe.bags import Recording
    from coframe.buffer.explanation import ChainEdge, Explanation
    from coframe.doctor import Finding, Report
    from coframe.doctor.collector import Collector

__all__ = ["why"]

_NAMES = "[BAG] TARGET SOURCE"
# The connection receives static transforms at about the same time as the doctor's node, which waits for them first.
_CLOCK_CODES = {"TF008", "TF009", "TF010"}
_SECOND_LISTENER = "500ms"
_ASCII_BRANCHES = str.maketrans("├└│─", "+`|-")
_STYLES = {"error": "bold red", "warning": "yellow", "note": "cyan"}


class _Answer(NamedTuple):
    """An explanation, the doctor's findings about its edges, and notes about transforms on other topics."""

    found: Explanation
    reports: list[Report]
    notes: list[str]


@click.command(cls=Command)
@argument(
    "names",
    metavar=_NAMES,
    nargs=-1,
    shell_complete=complete_frames,
    help="The two frames, in the same order as in coframe lookup. Omit BAG to use the live ROS graph.",
)
@click.option(
    "--at",
    "-t",
    metavar="TIME",
    help=f"Time of the lookup: {TIMES}; for the live graph also 'now'. [default: 'end', the latest common time]",
)
@click.option(
    "--duration", "--timeout", metavar="DURATION", type=PositiveDuration, default="2s", help="Observation time."
)
@click.option("--watch", is_flag=True, help="Update the answer every second.")
@click.option("--json", "as_json", is_flag=True, help="Print one line of JSON per answer; times are in nanoseconds.")
@namespace_option
@domain_option
@recorded_listener_options
def why(
    names: tuple[str, ...],
    at: str | None,
    duration: PositiveDuration,
    watch: bool,
    as_json: bool,
    namespace: str | None,
    domain: int | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
) -> None:
    """Explain why the transform from SOURCE to TARGET is or is not available.

    The output lists each edge of the chain with its publisher and age, and what to change. The exit code is 0 if the
    transform is available, and 1 otherwise.

    Example: coframe why base_link camera_link --at now
    """
    if len(names) not in {2, 3}:
        fail("Give the frames TARGET and SOURCE, or a recording and the two frames.", code=2)
    *bags, target, source = names
    if not bags and Path(target).exists() and not {"/", "."}.isdisjoint(target):
        fail(f"{target} is a file or a folder. Give TARGET and SOURCE after the recording.", code=2)
    if watch and bags:
        fail("--watch cannot be combined with a recording", code=2)
    with run_until_interrupted() if watch else run_to_completion():
        if bags:
            choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
            answer = _answer_recorded(bags[0], choice, target, source, at)
        else:
            config = ListenerConfig.of(
                domain=domain,
                namespace=namespace,
                tf_topic=tf_topic,
                tf_static_topic=tf_static_topic,
                prefix=prefix,
                keep=keep,
            )
            if watch:
                _watch(config, target, source, at, duration, as_json=as_json)
            answer = _answer_live(config, target, source, at, duration)
        _print(answer, as_json=as_json)
        raise Exit(0 if answer.found.possible else 1)


def _answer_recorded(bag: str, choice: TransformChoice, target: str, source: str, at: str | None) -> _Answer:
    collectors: dict[str, Collector] = {}
    with open_recording(bag, choice, collecting_callback(collectors, choice)) as recording:
        check_has_transforms(recording)
        if at is not None and at.strip() == "now":
            fail("--at now: a recording has no current time. Give a time of the recording, or 'end'.", code=2)
        found = recording.buffer.why(target, source, None if at is None else parse_lookup_time("--at", at, recording))
        seen = [
            Observation(
                live=False,
                start=recording.received_start,
                end=recording.received_end,
                transforms=collectors[name].transforms(),
            )
            for name in sorted(collectors)
        ]
        return _answer(found, seen, _other_namespaces(found, recording))


def _answer_live(config: ListenerConfig, target: str, source: str, at: str | None, window: int) -> _Answer:
    from coframe.doctor.live import LiveObserver  # noqa: PLC0415 - recordings need no middleware

    with (
        Connection("coframe_why", config) as ros,
        LiveObserver(config, node_name="coframe_why_doctor") as observer,
    ):
        if Console(stderr=True).is_terminal:
            click.echo(f"observing for {window / SECOND:g} s ...", err=True)
        observer.listen(window / SECOND)
        if not ros.buffer.can_transform(target, source):
            # Without all static transforms, existing frames would be reported as missing.
            observer.listen_for_statics()
            ros.wait_for_statics(_SECOND_LISTENER)
        seen = observer.observe()
        clock = int(seen.clock.stamp[-1]) if seen.clock is not None else None
        found = ros.buffer.why(target, source, _lookup_time(at, clock, window), now=clock)
        return _answer(found, [seen], [*_await_transforms(found, ros), *_other_topics(found, ros)])


def _answer(explanation: Explanation, observations: Sequence[Observation], notes: Iterable[str]) -> _Answer:
    """Return the explanation with the findings about its edges. Edges that still arrive are not stale."""
    alive = {edge.key for one in observations if one.live for edge in one.dynamic if not one.is_stale(edge)}
    edges = (edge._replace(stale=False) if (edge.parent, edge.child) in alive else edge for edge in explanation.edges)
    explanation = replace(explanation, edges=tuple(edges))
    reports = _relevant_reports(explanation, observations)
    return _Answer(_add_clock_advice(explanation, reports), reports, list(notes))


def _add_clock_advice(explanation: Explanation, reports: Iterable[Report]) -> Explanation:
    """Return the explanation with the advice of the finding about the clock of its edges, if that is the cause."""
    of_clocks = [one for report in reports for one in report.findings if one.code in _CLOCK_CODES]
    if explanation.possible or explanation.roots is not None or explanation.unknown or not of_clocks:
        return explanation
    if explanation.span is not None and not any(edge.state == "too_new" for edge in explanation.edges):
        return explanation
    code = of_clocks[0].code
    names = {" -> ".join(edge) for one in of_clocks for edge in (one.edge, *one.edges) if edge is not None}
    subject = join_names(edge.name for edge in explanation.edges if edge.name in names)
    return replace(explanation, hint=f"The stamps of {subject} are wrong: see {code} below. See doctor code {code}.")


def _watch(config: ListenerConfig, target: str, source: str, at: str | None, window: int, *, as_json: bool) -> NoReturn:
    """Print an answer every second, without the doctor, until Ctrl-C."""
    from coframe.wire.qos import QoS  # noqa: PLC0415 - recordings need no middleware

    with Connection("coframe_why", config) as ros, Live(console=Console(highlight=False), auto_refresh=False) as live:
        ticks: deque[Any] = deque(maxlen=1)
        ros.subscribe("/clock", find("rosgraph_msgs/msg/Clock"), ticks.append, QoS(depth=1, reliable=False))
        while True:
            clock = stamp_ns(ticks[0].clock) if ticks else None
            found = ros.buffer.why(target, source, _lookup_time(at, clock, window), now=clock)
            answer = _Answer(found, [], list(_await_transforms(found, ros)))
            if as_json:
                print(json.dumps(_data(answer)), flush=True)
            else:
                live.update(Group(*_styled_lines(answer, live.console)), refresh=True)
            time.sleep(1.0)


def _lookup_time(at: str | None, clock: int | None, window: int) -> int | None:
    """Return the time of a lookup in a window that ends now, or None for the latest."""
    if at is None:
        return None
    now = time.time_ns() if clock is None else clock
    try:
        return now if at.strip() == "now" else parse_time_point(at, (now - window, now))
    except ValueError as error:
        fail(f"--at: {error}", code=2)


def _relevant_reports(explanation: Explanation, observations: Iterable[Observation]) -> list[Report]:
    """Return the findings about the edges of the chain and, if the chain is incomplete, about its frames."""
    edges = {(edge.parent, edge.child) for edge in explanation.edges}
    frames = {explanation.target, explanation.source, *explanation.frames}
    incomplete = explanation.roots is not None or bool(explanation.unknown)

    def concerns(finding: Finding) -> bool:
        if finding.edge is not None:
            return not edges.isdisjoint({finding.edge, *finding.edges})
        return incomplete and (not finding.frames or not frames.isdisjoint(finding.frames))

    reports = map(diagnose, observations)
    return [
        report._replace(
            findings=[one.with_consequences(()) for one in report.every_finding() if concerns(one)], sensors=[]
        )
        for report in reports
    ]


def _other_namespaces(explanation: Explanation, recording: Recording) -> Iterator[str]:
    for frame in explanation.unknown:
        for name, buffer in recording.buffers.items():
            if frame in buffer:
                option = f"--namespace {shlex.quote(name or '/')}"
                yield f"frame {frame!r} is published on {name}/tf: coframe why ... {option}"


def _await_transforms(explanation: Explanation, ros: Connection) -> Iterator[str]:
    if not explanation.possible and (nodes := ros.awaited_statics()):
        yield awaited_statics_text(nodes)


def _other_topics(explanation: Explanation, ros: Connection) -> Iterator[str]:
    if explanation.possible:
        return
    for topic, publishers in sorted(ros.participant.published().items()):
        types = {endpoint.ros_type for endpoint in publishers.values()}
        if TF_MESSAGE in types and topic not in ros.config.topics:
            option = "--tf-static-topic" if topic.endswith("static") else "--tf-topic"
            yield f"transforms are also published on {topic}: coframe why ... {option} {shlex.quote(topic)}"


def _print(answer: _Answer, *, as_json: bool) -> None:
    if as_json:
        print(json.dumps(_data(answer)))
        return
    console = Console(highlight=False, soft_wrap=True)
    for text in _styled_lines(answer, console):
        console.print(text)


def _styled_lines(answer: _Answer, console: Console) -> list[Text]:
    first, *rest = for_command_line(_replace_advice(answer.found, str(answer.found))).split("\n")
    lines = [("green" if answer.found.possible else "bold red", first), *(("", line) for line in rest)]
    for report in answer.reports:
        for finding in report.findings:
            lines += [(_STYLES[str(finding.severity)], headline(finding)), ("", f"      do:  {finding.fix}")]
    lines += [("", note) for note in answer.notes]
    shown = [(style, one_line(line)) for style, line in lines]
    if console.options.ascii_only:
        shown = [(style, line.translate(_ASCII_BRANCHES)) for style, line in shown]
    return [Text(line, style=style) for style, line in shown]


def _replace_advice(explanation: Explanation, text: str) -> str:
    """Replace the library's advice about a missing edge with the command that publishes it."""
    return text if explanation.missing is None else text.replace(explanation.missing.hint, explanation.missing.fix)


def _data(answer: _Answer) -> dict[str, Any]:
    found = answer.found
    return {
        "possible": found.possible,
        "target": found.target,
        "source": found.source,
        "stamp_ns": found.stamp or None,
        "answered_ns": found.answered,
        "code": found.code or None,
        "verdict": verdict_text(found),
        "text": found.text or None,
        "hint": for_command_line(_replace_advice(found, found.hint)) or None,
        "frames": list(found.frames),
        "edges": [_edge_data(found, edge) for edge in found.edges],
        "unknown": list(found.unknown),
        "roots": found.roots,
        "missing": found.missing and found.missing[:2],
        "limit": found.limit,
        "span_ns": found.span,
        "possible_at_ns": found.possible_at,
        "findings": [finding for report in answer.reports for finding in as_data(report)["findings"]],
        "notes": answer.notes,
    }


def _edge_data(explanation: Explanation, edge: ChainEdge) -> dict[str, Any]:
    times = {"by", "oldest", "newest", "age", "gap", "period"}
    named = {f"{name}_ns" if name in times else name: value for name, value in edge._asdict().items()}
    return {**named, "remark": edge_remark(explanation, edge)}
