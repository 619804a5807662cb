# SPDX-License-Identifier: Apache-2.0
"""Edit a recording: read it once, apply rules to its messages, and write a copy in the same format."""

from __future__ import annotations

import shutil
import uuid
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from coframe._files.os_errors import reason
from coframe._output import html_tables
from coframe._sources.sources import as_source
from coframe.bags._compression import DamagedError
from coframe.bags._problems import Problems
from coframe.bags._recorded_types import RecordedTypes
from coframe.bags.editing._files import read_input
from coframe.bags.editing._metadata import EditedFile, edited_metadata, metadata_text, new_metadata
from coframe.bags.editing._pipeline import Pipeline
from coframe.bags.editing._recipe import Recipe
from coframe.bags.editing._survey import Survey
from coframe.bags.formats import METADATA
from coframe.errors import CoframeError, RecordingError

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable, Iterator

    from coframe._sources.sources import Location
    from coframe.bags.editing._files import EditedInput
    from coframe.bags.editing._rule import Rule

__all__ = ["DamagedRecordingError", "EditReport", "RuleCount", "edit"]


class DamagedRecordingError(RecordingError):
    """A damaged recording, which has to be repaired before it can be edited."""


class RuleCount(NamedTuple):
    """What one rule did.

    Attributes:
        rule: Its name and value.
        changes: How many things it changed, added or removed.
        text: The same in words: ``3 frame names changed``.
        hint: If it changed nothing, similar names that exist; may be empty.
    """

    rule: str
    changes: int
    text: str
    hint: str


class EditReport(NamedTuple):
    """The result of :func:`edit`.

    Attributes:
        path: The new recording, or None for a dry run.
        messages: Number of messages in it.
        rules: What each rule did, in their order.
        notes: What else is different from the input, or could not be edited, one message each.
    """

    path: Path | None
    messages: int
    rules: list[RuleCount]
    notes: list[str]

    def _repr_html_(self) -> str:
        return html_tables.record(f"Edited {self.path}" if self.path else "Dry run", self._asdict().items())

    @property
    def unmatched(self) -> list[RuleCount]:
        """The rules that changed nothing."""
        return [rule for rule in self.rules if not rule.changes]


def edit(
    source: Location,
    target: str | os.PathLike[str] | None,
    recipe: Recipe | Iterable[str | tuple[str, str]],
    *,
    compression: str | None = None,
    progress: Callable[[int, int], object] = lambda _done, _total: None,
) -> EditReport:
    """Write an edited copy of a recording; the original is not changed.

    The messages are read once, one chunk after the other, in constant memory. What the rules do not name stays as it
    is: bytes, order, receive times, QoS, definitions, attachments and metadata. MCAP stays MCAP, and SQLite stays
    SQLite; formats that coframe only reads, such as ROS 1 bags, become MCAP. A failure or Ctrl-C leaves no output.

    Args:
        source: A file, or a folder of rosbag2.
        target: The new recording, which must not exist: a file if the name has the suffix of the format, such as
            ``fixed.mcap``, else a folder of rosbag2. None only counts what the rules would change.
        recipe: The rules.
        compression: Compression of the chunks of MCAP files: ``zstd``, ``lz4`` or ``none``; None keeps it.
        progress: Called regularly with the number of bytes read and the total number.

    Raises:
        RecordingError: The recording cannot be read or is damaged, or the copy cannot be written.
        EditError: There is no such rule, or a rule cannot be applied to this recording.

    Example:
        >>> coframe.bags.edit("run.mcap", "fixed.mcap", ["rename-frame Lidar=lidar"])        # doctest: +SKIP
    """
    chosen = recipe if isinstance(recipe, Recipe) else Recipe(recipe)
    file = as_source(source)
    if not isinstance(file, Path):
        hint = f"Copy it to this machine first: coframe bag convert {file} FOLDER"
        raise RecordingError(f"{file} cannot be edited: it is not on this machine", hint=hint)
    source, target = file, None if target is None else Path(target)
    if target is not None and (target.exists() or target.is_symlink()):
        raise RecordingError(f"{target} already exists and is not overwritten", hint="Choose another name.")
    problems, types, rules = Problems(), RecordedTypes(), chosen.rules()
    with ExitStack() as closing:
        try:
            opened = read_input(source, types, problems, closing)
            survey = Survey(opened, types)
            pipeline = Pipeline(rules, survey, types, problems)
            part = None if target is None else closing.enter_context(_remove_if_incomplete(target))
            files = _write(opened, target, part, pipeline, compression, progress)
            counts = [_count_changes(rule, Survey(opened, types)) for rule in rules]
        except DamagedError as error:
            raise DamagedRecordingError(
                f"{source} is damaged: {error}", hint="Repair it first: `coframe bag fix BAG OUT`, then edit OUT."
            ) from None
        except OSError as error:
            raise RecordingError(f"{error.filename or source}: {reason(error)}") from error
    remarks = [remark for rule in rules for remark in rule.remarks()]
    notes = [*opened.notes, *problems.sentences(), *remarks]
    return EditReport(target, sum(file.messages for file in files), counts, notes)


def _write(
    opened: EditedInput,
    target: Path | None,
    part: Path | None,
    pipeline: Pipeline,
    compression: str | None,
    progress: Callable[[int, int], object],
) -> list[EditedFile]:
    """Write the files, and metadata.yaml if the output is a folder."""
    suffix = opened.format.suffixes[0]
    is_file = target is not None and target.suffix.lower() == suffix
    if target is not None and is_file and len(opened.files) > 1:
        raise RecordingError(
            f"{target} is one file, but the recording has {len(opened.files)}", hint="Choose the name of a folder."
        )
    if part is not None and not is_file:
        part.mkdir()
    total, done = sum(file.size for file in opened.files), 0
    written = []
    for number, file in enumerate(opened.files):
        name = f"{target.name if target is not None else 'dry'}_{number}{suffix}"
        edited = EditedFile(target.name if target is not None and is_file else name)
        out = None if part is None else part if is_file else part / name
        inserted = pipeline.inserted if number == 0 else []
        file.edit(out, pipeline, inserted, compression, edited, partial(_add, progress, done, total))
        done += file.size
        written.append(edited)
    progress(total, total)
    if part is not None and not is_file:
        channels = [*opened.channels(), *opened.listed]
        if opened.metadata:
            metadata = edited_metadata(opened.metadata, pipeline, written)
        else:
            metadata = new_metadata(channels, pipeline, written, opened.format.storage_id)
        (part / METADATA).write_text(metadata_text(metadata), encoding="utf-8")
    return written


def _add(progress: Callable[[int, int], object], previous: int, total: int, read: int) -> None:
    progress(previous + read, total)


def _count_changes(rule: Rule, survey: Survey) -> RuleCount:
    nouns = rule.unit if rule.changes == 1 else f"{rule.unit}s"
    text = f"{rule.changes} {nouns} {rule.verb}"
    try:
        hint = "" if rule.changes else rule.nearest(survey)
    except CoframeError:
        hint = ""
    return RuleCount(str(rule).strip(), rule.changes, text, hint)


@contextmanager
def _remove_if_incomplete(target: Path) -> Iterator[Path]:
    """Yield a temporary path next to the target. It is renamed to the target after everything has been written."""
    part = target.with_name(f".{target.name}.{uuid.uuid4().hex[:12]}.part")
    try:
        part.parent.mkdir(parents=True, exist_ok=True)
        yield part
        if target.exists():
            raise RecordingError(f"{target} was created by another program and is not overwritten")
        part.rename(target)
    finally:
        if part.is_dir():
            shutil.rmtree(part, ignore_errors=True)
        else:
            part.unlink(missing_ok=True)
