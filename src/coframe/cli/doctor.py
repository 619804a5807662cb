# SPDX-License-Identifier: Apache-2.0
"""``coframe doctor``: finds problems with transforms, live or in a recording."""

from __future__ import annotations

import difflib
import json
import time
from functools import partial
from typing import TYPE_CHECKING, Any, NoReturn

import click
from click.exceptions import Exit
from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

from coframe._process.freed_memory import return_freed_arrays
from coframe.bags.namespaces import ALL_TRANSFORMS, TransformChoice
from coframe.cli.declaration import PATH, Command
from coframe.cli.doctor_clocks import show_clocks
from coframe.cli.doctor_fix import fix_recording, print_recipe
from coframe.cli.lifecycle import run_to_completion, run_until_interrupted
from coframe.cli.mount_history import measured_in, pair_options, print_history
from coframe.cli.options import (
    PositiveDuration,
    domain_option,
    namespace_option,
    optional_bag_argument,
    recorded_listener_options,
)
from coframe.cli.output import fail, one_line, printable
from coframe.cli.progress import reading_progress
from coframe.connection.listener_config import ListenerConfig
from coframe.doctor import Severity, codes, diagnose, page
from coframe.doctor.codes import built_in_codes
from coframe.doctor.recorded import observe_chosen
from coframe.doctor.rendering.plain import as_data
from coframe.doctor.rendering.sarif import as_sarif
from coframe.doctor.rendering.text import report_lines

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from coframe._sources.sources import Readable
    from coframe.doctor import Report
    from coframe.doctor.live import LiveObserver

__all__ = ["doctor"]

_DEFAULT_CACHE = PositiveDuration("10s")
_STYLES = {"error": "bold red", "warning": "yellow", "note": "cyan", "good": "green", "dim": "dim", "plain": ""}
# --watch uses at most this fraction of a CPU core for its diagnoses.
_CPU_SHARE = 0.006
# The parameters that --baseline uses.
_MOUNT_PARAMETERS = {"bag", "baselines", "pairs", "rigid", "as_json"}


@click.command(cls=Command)
@optional_bag_argument
@click.option("--watch", is_flag=True, help="Update the findings continuously.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON; times are in nanoseconds.")
@click.option("--sarif", is_flag=True, help="Print SARIF 2.1.0.")
@click.option(
    "--system", is_flag=True, help="Check this machine instead: DDS library, network, environment variables and nodes."
)
@click.option(
    "--report",
    "-r",
    "shows_graph",
    is_flag=True,
    help="Describe this machine and the ROS graph instead: nodes, topics, services, actions and QoS, like ros2 doctor.",
)
@click.option("--include-warnings", "-iw", is_flag=True, hidden=True)
@click.option("--report-failed", "-rf", is_flag=True, hidden=True)
@click.option("--exclude-packages", "-ep", is_flag=True, hidden=True)
@click.option("--ignore", metavar="CODE", multiple=True, help="Skip the check with this code; repeatable.")
@click.option(
    "--fail-on",
    metavar="SEVERITY",
    type=click.Choice(["error", "warning", "note", "never"]),
    default="warning",
    help="Lowest severity with exit code 1: error, warning, note or never.",
)
@click.option("--explain", metavar="CODE", help="Print the page about this code and exit.")
@click.option(
    "--list", "list_codes", is_flag=True, help="List all codes with their titles and exit; with --json, as JSON."
)
@click.option(
    "--duration",
    metavar="DURATION",
    type=PositiveDuration,
    default=_DEFAULT_CACHE,
    help="Observation time; with --watch, the time window; with --system, the maximum time of the search for nodes.",
)
@click.option(
    "--cache",
    metavar="DURATION",
    type=PositiveDuration,
    default=_DEFAULT_CACHE,
    help="Cache length to assume for listeners.",
)
@click.option(
    "--recipe",
    "shows_recipe",
    is_flag=True,
    help="Print the recipe that repairs the recording BAG, for `coframe bag edit --recipe`, instead of the report.",
)
@click.option(
    "--fix", "fixed", metavar="OUT", type=PATH, help="Write a repaired copy of the recording BAG, and examine it."
)
@click.option("--yes", "-y", is_flag=True, help="Apply the recipe of --fix without asking.")
@click.option(
    "--clocks", is_flag=True, help="Print the offset and the drift of each publisher's clock instead of the report."
)
@click.option(
    "--baseline",
    "baselines",
    metavar="BAG",
    multiple=True,
    help="Earlier recording of the robot: find sensors that have moved since then, instead of the report; repeatable.",
)
@pair_options
@click.option(
    "--output", "-o", metavar="FILE", type=PATH, help="With --clocks: a plot of the delays (.svg, .png, .html)."
)
@namespace_option
@domain_option
@recorded_listener_options
def doctor(
    bag: Readable | None,
    watch: bool,
    as_json: bool,
    sarif: bool,
    system: bool,
    shows_graph: bool,
    include_warnings: bool,
    report_failed: bool,
    exclude_packages: bool,
    ignore: tuple[str, ...],
    fail_on: str,
    explain: str | None,
    list_codes: bool,
    duration: PositiveDuration,
    cache: PositiveDuration,
    shows_recipe: bool,
    fixed: Path | None,
    yes: bool,
    clocks: bool,
    baselines: tuple[str, ...],
    pairs: tuple[tuple[str, str], ...],
    rigid: tuple[tuple[str, str], ...],
    output: Path | None,
    namespace: str | None,
    domain: int | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
) -> None:
    """Find problems with the transforms, live or in the recording BAG: what is wrong, why, and what to do.

    If nodes do not find each other, start with `coframe doctor --system`.

    The exit code is 0 if there are no errors or warnings (notes do not count), and 1 otherwise; --fail-on changes this.
    With --fix, it is 0 if the repaired copy has none.

    Example: coframe doctor run.mcap --ignore TF018

    Example: coframe doctor run.mcap --fix repaired.mcap

    Example: coframe doctor thursday.mcap --baseline tuesday.mcap --baseline wednesday.mcap
    """
    if list_codes or explain is not None:
        _print_page(explain, as_json)
        return
    del include_warnings, exclude_packages  # Warnings are always shown, and packages never.
    if shows_graph or report_failed:
        from coframe.cli.ros2.graph_report import print_graph  # noqa: PLC0415 - needs the ROS packages

        print_graph()
    if system or shows_graph or report_failed:
        _check_system(bag, domain, duration, as_json=as_json, watch=watch, sarif=sarif)
        return
    if baselines or pairs or rigid:
        _compare_mounts(bag, baselines, pairs, rigid, as_json=as_json)
        return
    ignored = _known_codes(ignore)
    _check_combination(bag, watch=watch, as_json=as_json, sarif=sarif)
    _check_clocks(
        output, clocks=clocks, others={"--watch": watch, "--sarif": sarif, "--recipe": shows_recipe, "--fix": fixed}
    )
    if fixed is not None or shows_recipe:
        has_choice = bool(namespace or tf_topic or tf_static_topic or prefix)
        _require_plain_recording(bag, has_choice or watch or as_json or sarif)
    choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
    with run_until_interrupted() if watch else run_to_completion():
        if bag is None:
            reports = {"": _examine_graph(choice, domain, cache, duration, ignored, watch=watch, as_json=as_json)}
        else:
            reports = _reports(bag, choice, ignored, cache)
        if clocks:
            show_clocks({name: report.observation for name, report in reports.items()}, output, as_json=as_json)
        elif shows_recipe:
            print_recipe(reports)
        else:
            if bag is not None and fixed is not None:
                _print(reports)
                examine = partial(_examine, ignored_codes=ignored, cache=cache)
                fix_recording(bag, fixed, reports, examine, yes=yes)
            _print_and_exit(reports, as_json, sarif, bag, fail_on)


def _compare_mounts(
    bag: Readable | None,
    baselines: tuple[str, ...],
    pairs: tuple[tuple[str, str], ...],
    rigid: tuple[tuple[str, str], ...],
    *,
    as_json: bool,
) -> None:
    """Print which sensors have moved since the earlier recordings, and exit with 1 if one of them has."""
    if bag is None or not baselines:
        fail("--baseline, --pair and --rigid need the recording BAG and a --baseline", code=2)
    context = click.get_current_context()
    for option in context.command.params:
        source = context.get_parameter_source(str(option.name))
        if option.name not in _MOUNT_PARAMETERS and source is click.core.ParameterSource.COMMANDLINE:
            fail(f"{option.opts[0]} and --baseline are mutually exclusive: --baseline replaces the report", code=2)
    with run_to_completion():
        if print_history(measured_in([*baselines, str(bag)], pairs, rigid), as_json=as_json):
            raise Exit(1)


def _examine_graph(
    choice: TransformChoice,
    domain: int | None,
    cache: PositiveDuration,
    duration: PositiveDuration,
    ignored_codes: list[str],
    *,
    watch: bool,
    as_json: bool,
) -> Report:
    """Return the report about the live graph; with `watch`, update it until Ctrl-C instead."""
    from coframe.doctor.live import LiveObserver  # noqa: PLC0415 - recordings need no middleware

    config = ListenerConfig.of(
        domain=domain,
        namespace=choice.namespace,
        tf_topic=choice.tf_topic,
        tf_static_topic=choice.tf_static_topic,
        prefix=choice.prefix,
        keep=choice.keep,
        cache=cache,
    )
    with LiveObserver(config, window=duration if watch else None) as observer:
        if watch:
            _watch(observer, ignored_codes, as_json)
        if Console(stderr=True).is_terminal:
            click.echo(f"observing for {duration} ...", err=True)
        observer.listen(duration.seconds)
        observer.listen_for_statics()
        return diagnose(observer.observe(), ignore=ignored_codes)


def _check_clocks(output: Path | None, *, clocks: bool, others: dict[str, object]) -> None:
    if output is not None and not clocks:
        fail("--output is the plot of --clocks; add --clocks", code=2)
    for name, given in others.items():
        if clocks and given:
            fail(f"--clocks cannot be combined with {name}", code=2)


def _check_combination(bag: Readable | None, *, watch: bool, as_json: bool, sarif: bool) -> None:
    if as_json and sarif:
        fail("--json cannot be combined with --sarif", code=2)
    if watch and (sarif or bag is not None):
        fail(f"--watch cannot be combined with {'--sarif' if sarif else 'a recording'}", code=2)


def _check_system(
    bag: Readable | None, domain: int | None, duration: PositiveDuration, *, as_json: bool, watch: bool, sarif: bool
) -> None:
    for given, name in ((bag is not None, "a recording"), (watch, "--watch"), (sarif, "--sarif")):
        if given:
            fail(f"--system cannot be combined with {name}", code=2)
    from coframe.cli.doctor_system import examine_system  # noqa: PLC0415 - checks of transforms need none of it

    with run_to_completion():
        if Console(stderr=True).is_terminal:
            click.echo(f"searching for nodes for up to {duration} ...", err=True)
        examine_system(domain, duration.seconds, as_json=as_json)


def _print_page(code: str | None, as_json: bool) -> None:
    """Print the page about a code, or the list of all codes."""
    if code is None:
        _list_codes(as_json)
    else:
        _explain(code)


def _list_codes(as_json: bool) -> None:
    titles = {code: page(code).title for code in codes()}
    if as_json:
        print(json.dumps([{"code": code, "title": title} for code, title in titles.items()]))
        return
    for code, title in titles.items():
        print(f"{code}  {title}")


def _explain(code: str) -> None:
    try:
        text = page(code).text
    except KeyError:
        fail(f"--explain: unknown code {code!r}", _similar_codes(code), code=2)
    console = Console()
    if console.is_terminal:
        from rich.markdown import Markdown  # noqa: PLC0415 - slow import

        console.print(Markdown(text))
    else:
        print(text, end="")


def _known_codes(options: Iterable[str]) -> list[str]:
    every = [code.strip().upper() for option in options for code in option.split(",")]
    for code in every:
        if code not in codes():
            fail(f"--ignore: unknown code {code!r}", _similar_codes(code), code=2)
    return every


def _similar_codes(code: str) -> str:
    """Suggest codes with a similar spelling or whose title contains the word; otherwise return the range of codes."""
    words = code.lower()
    by_title = [known for known in codes() if len(words) > 2 and words in page(known).title.lower()]
    near = by_title or difflib.get_close_matches(code.upper(), codes(), n=3, cutoff=0.8)
    if not near:
        own, others = built_in_codes(), codes()[len(built_in_codes()) :]
        return f"The codes are {own[0]} to {own[-1]}{''.join(f', {other}' for other in others)}."
    return f"Did you mean {' or '.join(f'{known} ({page(known).title})' for known in near)}?"


def _print_and_exit(reports: dict[str, Report], as_json: bool, sarif: bool, bag: Readable | None, fail_on: str) -> None:
    """Print the reports, and end the command with exit code 1 for findings of a severity, otherwise 0."""
    if sarif:
        print(json.dumps(as_sarif(reports, bag), indent=2))
    elif as_json:
        data: Any = {name: as_data(report) for name, report in reports.items()}
        print(json.dumps(data[""] if list(data) == [""] else {"namespaces": data}, indent=2))
    else:
        _print(reports)
    raise Exit(0 if all(_passes(report, fail_on) for report in reports.values()) else 1)


def _passes(report: Report, fail_on: str) -> bool:
    """Return whether a report has transforms and no findings of a severity; without transforms, only `never` passes."""
    if fail_on == "never":
        return True
    lowest = Severity[fail_on.upper()]
    has_transforms = len(report.observation.transforms) > 0
    return has_transforms and all(finding.severity < lowest for finding in report.every_finding())


def _print(reports: dict[str, Report]) -> None:
    console = Console(highlight=False, soft_wrap=True)
    for name, report in reports.items():
        if len(reports) > 1:
            console.print(Text(printable(f"{name or '/'}:"), style="bold"))
        for line in _styled_lines(report):
            console.print(line)


def _reports(
    bag: Readable, choice: TransformChoice, ignored_codes: list[str], cache: PositiveDuration
) -> dict[str, Report]:
    """Return the report about each namespace of a recording."""
    with reading_progress() as progress:
        observations = observe_chosen(bag, choice, cache=cache, progress=progress)
    return {name: diagnose(observation, ignore=ignored_codes) for name, observation in observations.items()}


def _examine(path: Path, ignored_codes: list[str], cache: PositiveDuration) -> dict[str, Report]:
    """Print the reports about a repaired recording, and return them."""
    reports = _reports(path, ALL_TRANSFORMS, ignored_codes, cache)
    _print(reports)
    return reports


def _require_plain_recording(bag: Readable | None, has_other_options: bool) -> None:
    if bag is None:
        fail("--fix and --recipe need a recording", code=2)
    if has_other_options:
        fail(
            "--fix and --recipe examine the whole recording and print text: remove the options that change this", code=2
        )


def _styled_lines(report: Report) -> list[Text]:
    every = [Text(one_line(line), style=_STYLES[style]) for style, line in report_lines(report)]
    every += [Text(f"recording: {one_line(problem)}", style="dim") for problem in report.observation.unread]
    return every


def _watch(observer: LiveObserver, ignore: list[str], as_json: bool) -> NoReturn:
    """Update the report every second, or less often if the diagnosis takes long, until Ctrl-C."""
    return_freed_arrays()
    console = Console(highlight=False)
    with Live(console=console, auto_refresh=False, screen=False, transient=False) as live:
        observer.listen(1.0)  # Discovery takes time: initially, every graph looks empty.
        while True:
            begun = time.process_time()
            report = diagnose(observer.observe(), ignore=ignore)
            if as_json:
                print(json.dumps(as_data(report)), flush=True)
            else:
                live.update(Group(*_styled_lines(report)), refresh=True)
            del report  # with all transforms of the window
            observer.listen(max(1.0, (time.process_time() - begun) / _CPU_SHARE))
