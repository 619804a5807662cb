# SPDX-License-Identifier: Apache-2.0
"""``coframe contract``: states what a good recording contains, and checks recordings or the running system."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.exceptions import Exit
from rich.console import Console

from coframe._files.complete_files import write_complete
from coframe._output.formatting import count
from coframe.bags.formats import file_kinds
from coframe.bags.namespaces import TransformChoice
from coframe.cli.completion import complete_recordings
from coframe.cli.declaration import PATH, RECORDING, CommandGroup, argument
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    PositiveDuration,
    bag_argument,
    domain_option,
    namespace_option,
    recorded_listener_options,
)
from coframe.cli.output import fail, fail_to_write, one_line, printable
from coframe.cli.progress import reading_progress
from coframe.contract import (
    Verdict,
    check_contract,
    check_recording,
    contract_yaml,
    derive_contract,
    measure_live,
    measure_recording,
    read_contract,
)
from coframe.contract.rendering import as_annotations, as_data, as_junit, as_markdown, as_sarif
from coframe.errors import ContractError, WireError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe._sources.sources import Readable
    from coframe.contract import Contract

__all__ = ["contract"]

_LIVE = "live"
_BROKEN, _UNREADABLE = 1, 2  # exit codes

contract = CommandGroup(
    "contract",
    help="State what a good recording contains, and check recordings or the running system.\n\n"
    "Example: coframe contract check runs/*.mcap -c contract.yaml",
)


@contract.command(short_help="Derive a contract from a good recording.")
@bag_argument
@click.option("--output", "-o", metavar="FILE", type=PATH, default="contract.yaml", help="Contract to write.")
@click.option("--force", is_flag=True, help="Replace an existing file.")
@namespace_option
@recorded_listener_options
def init(
    bag: Readable,
    output: Path,
    force: bool,
    namespace: str | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
) -> None:
    """Derive a contract from the good recording BAG: frames, static values, rates, topics, QoS, delays and clocks.

    Rates have a margin of 20 %, gaps of 50 %. Read the file and adapt it: it states what every recording must contain.

    Example: coframe contract init good.mcap -o contract.yaml
    """
    if output.exists() and not force:
        fail(f"{output} exists", "Write to another file with -o, or replace it with --force.")
    with run_to_completion():
        choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
        with reading_progress() as progress:
            measurement = measure_recording(bag, choice, progress=progress)
        derived = derive_contract(measurement)
        try:
            write_complete(output, contract_yaml(derived, source=bag.name).encode())
        except OSError as error:
            fail_to_write(output, error)
    print(
        f"{printable(str(output))}: {count(len(derived.transforms), 'transform')}, "
        f"{count(len(derived.topics), 'topic')}, {count(len(derived.availability), 'delay')}"
    )
    for each in derived.ignore:
        print(f"  {each.code} is accepted, because it is {one_line(each.reason)}")


@contract.command(short_help="Check recordings, or the running system, against a contract.")
@argument(
    "bags",
    metavar="BAG...",
    type=RECORDING,
    nargs=-1,
    required=True,
    shell_complete=complete_recordings,
    help=lambda: f"Recordings: {file_kinds()}, rosbag2 folders, or their URLs; the word `live` is the running system.",
)
@click.option("--contract", "-c", "file", metavar="FILE", type=PATH, default="contract.yaml", help="Contract to check.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
@click.option("--github", is_flag=True, help="Print problems as annotations of GitHub Actions.")
@click.option("--junit", metavar="FILE", type=PATH, help="Write JUnit XML.")
@click.option("--sarif", metavar="FILE", type=PATH, help="Write SARIF 2.1.0.")
@click.option("--markdown", metavar="FILE", type=PATH, help="Write a summary in Markdown.")
@click.option(
    "--duration", metavar="DURATION", type=PositiveDuration, default="10s", help="Observation time of `live`."
)
@namespace_option
@domain_option
@recorded_listener_options
def check(
    bags: tuple[Readable, ...],
    file: Path,
    as_json: bool,
    github: bool,
    junit: Path | None,
    sarif: Path | None,
    markdown: Path | None,
    duration: PositiveDuration,
    namespace: str | None,
    domain: int | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
) -> None:
    """Check the recordings BAG... against a contract; `live` checks the running system.

    The exit code is 0 if all recordings satisfy the contract, 1 if one violates it, and 2 if a recording or the
    contract cannot be read, or a report cannot be written.

    Example: coframe contract check runs/*.mcap -c contract.yaml --junit contract.xml
    """
    if as_json and github:
        fail("--json cannot be combined with --github", code=2)
    try:
        required = read_contract(file)
    except ContractError as error:
        derive = "Derive a contract from a good recording: coframe contract init GOOD.mcap"
        fail(str(error), error.hint if file.exists() else derive, code=_UNREADABLE)
    choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
    verdicts: list[Verdict] = []
    with run_to_completion():
        for verdict in _verdicts(required, bags, choice, duration, domain):
            verdicts.append(verdict)
            if not as_json and not github:
                print(printable(verdict.text()), flush=True)
        if as_json:
            print(json.dumps(as_data(verdicts), indent=2))
        for line in as_annotations(verdicts) if github else ():
            print(printable(line))
        _write(junit, as_junit(verdicts))
        _write(sarif, json.dumps(as_sarif(verdicts), indent=2).encode())
        _write(markdown, as_markdown(verdicts).encode())
    if any(verdict.unreadable for verdict in verdicts):
        raise Exit(_UNREADABLE)
    raise Exit(0 if all(verdict.is_kept for verdict in verdicts) else _BROKEN)


def _verdicts(
    contract: Contract,
    bags: tuple[Readable, ...],
    choice: TransformChoice,
    duration: PositiveDuration,
    domain: int | None,
) -> Iterator[Verdict]:
    for bag in bags:
        if isinstance(bag, Path) and str(bag) == _LIVE and not bag.exists():
            yield _check_live(contract, choice, duration, domain)
        else:
            with reading_progress() as progress:
                verdict = check_recording(contract, bag, choice, progress=progress)
            yield verdict


def _check_live(contract: Contract, choice: TransformChoice, duration: PositiveDuration, domain: int | None) -> Verdict:
    from coframe.connection.listener_config import ListenerConfig  # noqa: PLC0415 - recordings need no middleware

    if Console(stderr=True).is_terminal:
        click.echo(f"observing for {duration} ...", err=True)
    try:
        config = ListenerConfig.of(
            domain=domain,
            namespace=choice.namespace,
            tf_topic=choice.tf_topic,
            tf_static_topic=choice.tf_static_topic,
            prefix=choice.prefix,
            keep=choice.keep,
        )
        measurement = measure_live(config, duration.seconds, [each.name for each in contract.topics])
    except WireError as error:
        return Verdict.of_error(_LIVE, error)
    return Verdict(_LIVE, tuple(check_contract(contract, measurement)))


def _write(path: Path | None, content: bytes) -> None:
    if path is None:
        return
    try:
        write_complete(path, content)
    except OSError as error:
        fail_to_write(path, error, code=_UNREADABLE)
