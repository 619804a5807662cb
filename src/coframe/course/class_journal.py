# SPDX-License-Identifier: Apache-2.0
"""The journal of a class that is being graded: each result is written when it is known, so that nothing is lost."""

from __future__ import annotations

import hashlib
import json
import os
from typing import TYPE_CHECKING, Any

from coframe._files.regular_files import read_regular

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

__all__ = ["Journal", "fingerprint"]

_MAX_BYTES = 1 << 30
_MAX_FILES, _MAX_FILE_BYTES = 500, 2 << 20  # of a submission that are part of its fingerprint


class Journal:
    """Results of submissions in a file with one line of JSON for each."""

    def __init__(self, path: Path) -> None:
        """Prepare a journal; the file is created with the first result."""
        self.path = path

    def results(self) -> dict[str, dict[str, Any]]:
        """Return the last complete result of each submission; incomplete and damaged lines are skipped."""
        found: dict[str, dict[str, Any]] = {}
        try:
            lines = read_regular(self.path, _MAX_BYTES).decode("utf-8", errors="replace").splitlines()
        except OSError:
            return found
        for line in lines:
            try:
                entry = json.loads(line)
                found[entry["submission"]] = {"key": entry["key"], "report": entry["report"]}
            except (ValueError, KeyError, TypeError):
                continue
        return found

    def add(self, submission: str, key: str, report: dict[str, Any]) -> None:
        """Write a result to the disk."""
        with self.path.open("a", encoding="utf-8", errors="backslashreplace") as file:
            file.write(json.dumps({"submission": submission, "key": key, "report": report}) + "\n")
            file.flush()
            os.fsync(file.fileno())

    def clear(self) -> None:
        """Delete the journal."""
        self.path.unlink(missing_ok=True)


def fingerprint(folder: Path, options: Sequence[object]) -> str:
    """Return a text that changes if the files of a submission or the options of the check change."""
    digest = hashlib.sha256(json.dumps([str(each) for each in options]).encode())
    count = 0
    for path, folders, names in os.walk(folder):
        folders.sort()
        for name in sorted(names):
            count += 1
            if count > _MAX_FILES:
                break
            file = os.path.join(path, name)  # noqa: PTH118 - fast, for many files
            digest.update(os.path.relpath(file, folder).encode(errors="surrogateescape"))
            try:
                digest.update(read_regular(file, _MAX_FILE_BYTES))
            except OSError:
                digest.update(b"unreadable")
    return digest.hexdigest()
