# SPDX-License-Identifier: Apache-2.0
"""``coframe calib history`` and ``coframe doctor --baseline``: mounts in several recordings, and sensors that moved."""

from __future__ import annotations

import csv
import io
import json
from datetime import datetime, timezone
from math import degrees
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

import click
from click.exceptions import Exit

from coframe._files.complete_files import complete_or_absent, write_complete
from coframe._output.formatting import error_text
from coframe._process.optional_imports import import_optional
from coframe.bags.namespaces import TransformChoice
from coframe.calibration import MAX_CHI_SQUARED, MeasuredMount, Movement, change_between, find_movements, measure_mounts
from coframe.cli.output import fail, fail_to_write, printable, warn
from coframe.cli.recordings import open_recording
from coframe.errors import CoframeError
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from pathlib import Path

__all__ = ["HISTORY_SUFFIXES", "measured_in", "pair_options", "print_history", "write_history"]

HISTORY_SUFFIXES = (".parquet", ".csv", ".json")
_NUMBERS = ("x", "y", "z", "qx", "qy", "qz", "qw")
_DEVIATIONS = ("sigma_x", "sigma_y", "sigma_z", "sigma_roll", "sigma_pitch", "sigma_yaw")


def pair_options(function: Callable[..., None]) -> Callable[..., None]:
    """Add the options that name what is compared."""
    for option in (
        click.option(
            "--rigid",
            metavar="ROOT:BODY ROOT:SENSOR",
            nargs=2,
            multiple=True,
            help="Two trajectories of one body, as for `calibrate rigid`; repeatable. --pair is more accurate.",
        ),
        click.option(
            "--pair",
            "pairs",
            metavar="TOPIC TOPIC",
            nargs=2,
            multiple=True,
            help="Two topics with poses of one object in the frames of two sensors; repeatable.",
        ),
    ):
        function = option(function)
    return function


def measured_in(
    bags: Iterable[str],
    pairs: tuple[tuple[str, str], ...],
    rigid: tuple[tuple[str, str], ...],
    *,
    skips_unreadable: bool = False,
) -> list[MeasuredMount]:
    """Return the mounts of all recordings, at least one; warn about recordings that do not show any.

    With `skips_unreadable`, a recording that cannot be read is a warning, and otherwise an error.
    """
    found: list[MeasuredMount] = []
    skipped = False
    for bag in bags:
        was_opened = False
        try:
            with open_recording(bag, TransformChoice()) as recording:
                was_opened = True
                mounts = measure_mounts(recording, pairs, rigid)
        except CoframeError as error:
            if not (was_opened or skips_unreadable):
                raise
            skipped |= not was_opened
            text = error_text(error).partition("\n")[0]
            warn(text if text.startswith(bag) else f"{bag}: {text}")
            continue
        if not mounts:
            warn(f"{bag}: no two sensors see one thing at the same time; name their topics with --pair")
        for mount in mounts:
            if not mount.fits:
                warn(
                    f"{bag}: the residuals of {mount.sources} do not fit one mount: chi squared is "
                    f"{mount.chi_squared:.1f}, and at most {MAX_CHI_SQUARED:g} is accepted"
                )
        found += mounts
    if not found:
        if skipped:  # The warnings name what is wrong with each recording.
            raise Exit(1)
        fail("no recording shows a mount", "Name two topics with poses of one object: --pair /left/tag /right/tag.")
    return found


def print_history(mounts: list[MeasuredMount], *, as_json: bool) -> bool:
    """Print the mounts by recording and the sensors that moved, and return whether one of these is confirmed."""
    series: dict[tuple[str, str, str], list[MeasuredMount]] = {}
    for mount in sorted(mounts, key=lambda each: each.start):
        series.setdefault(mount.name, []).append(mount)
    movements = [movement for one in series.values() for movement in find_movements(one)]
    if as_json:
        data = {"mounts": [_as_dict(mount) for mount in mounts], "movements": [_movement_dict(m) for m in movements]}
        print(json.dumps(data))
        return any(movement.is_confirmed for movement in movements)
    for (parent, child, sources), one in series.items():
        print(printable(f"{parent} -> {child}, by {sources}:"))
        for mount in one:
            print(printable(f"  {_day(mount)}  {_line(mount, one[0])}  {PurePath(mount.recording).name}"))
    for movement in movements:
        print(printable(_sentence(movement)))
    if not movements:
        print("no sensor has moved")
    return any(movement.is_confirmed for movement in movements)


def _line(mount: MeasuredMount, first: MeasuredMount) -> str:
    if not mount.fits:
        return f"refused: chi squared {mount.chi_squared:.1f}"
    if mount is first:
        return f"reference, {mount.count} poses"
    change = change_between(first.transform, mount.transform)
    return f"{_amount(change.radians, change.radians_deviation)}, {_length(change.meters, change.meters_deviation)}"


def _sentence(movement: Movement) -> str:
    change, child = movement.change, str(movement.after.transform.source)
    amounts = []
    if change.has_turned:
        amounts.append(_amount(change.radians, change.radians_deviation))
    if change.has_shifted:
        amounts.append(_length(change.meters, change.meters_deviation))
    since = f"since {_day(movement.before, weekday=True)} ({PurePath(movement.before.recording).name})"
    parent = movement.after.transform.target
    text = f"{child!r} has moved by {' and '.join(amounts)} relative to {parent!r} {since}"
    if movement.is_confirmed:
        return f"{text}; two recordings in a row show it, and /tf_static is unchanged. Calibrate it again."
    return f"{text}, but only one recording shows it: wait for a second one"


def _amount(radians: float, deviation: float) -> str:
    return f"{degrees(radians):.2f} +- {max(degrees(deviation), 0.01):.2f} degrees"


def _length(meters: float, deviation: float) -> str:
    return f"{1e3 * meters:.1f} +- {max(1e3 * deviation, 0.1):.1f} mm"


def _day(mount: MeasuredMount, *, weekday: bool = False) -> str:
    day = datetime.fromtimestamp(mount.start // SECOND, tz=timezone.utc)
    return f"{day:%A}, {day:%Y-%m-%d %H:%M}" if weekday else f"{day:%Y-%m-%d %H:%M}"


def _as_dict(mount: MeasuredMount) -> dict[str, Any]:
    deviations = [float(mount.transform.covariance[i][i]) ** 0.5 for i in range(6)]  # type: ignore[index]
    parent, child, sources = mount.name
    return {
        "recording": mount.recording,
        "stamp_ns": mount.start,
        "parent": parent,
        "child": child,
        "sources": sources,
        **dict(zip(_NUMBERS, map(float, mount.transform.values), strict=True)),
        **dict(zip(_DEVIATIONS, deviations, strict=True)),
        "chi_squared": mount.chi_squared,
        "fits": mount.fits,
        "count": mount.count,
    }


def _movement_dict(movement: Movement) -> dict[str, Any]:
    return {
        "parent": movement.after.transform.target,
        "child": movement.after.transform.source,
        "since": movement.before.recording,
        "until": movement.after.recording,
        **movement.change._asdict(),
        "confirmed": movement.is_confirmed,
    }


def write_history(mounts: list[MeasuredMount], path: Path) -> None:
    """Write one row per mount and recording: Parquet, CSV or JSON, in meters and radians."""
    rows = [_as_dict(mount) for mount in mounts]
    kind = path.suffix.lower()
    try:
        if kind == ".parquet":
            arrow = import_optional("pyarrow", "Writing Parquet", "parquet")
            parquet = import_optional("pyarrow.parquet", "Writing Parquet", "parquet")
            with complete_or_absent(path) as part:
                parquet.write_table(arrow.Table.from_pylist(rows), part)
        elif kind == ".csv":
            text = io.StringIO()
            writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
            write_complete(path, text.getvalue().encode())
        else:
            write_complete(path, (json.dumps(rows, indent=2) + "\n").encode())
    except OSError as error:
        fail_to_write(path, error)
