# SPDX-License-Identifier: Apache-2.0
"""What a contributor finds: the list of make targets, templates, and references to files that exist."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


def test_make_help_lists_every_target():
    makefile = (ROOT / "Makefile").read_text("utf-8")
    targets = {name for line in re.findall(r"^\.PHONY: (.+)$", makefile, re.MULTILINE) for name in line.split()}
    rules = set(re.findall(r"^([a-z][a-z-]*):", makefile, re.MULTILINE))
    output = subprocess.check_output(["make", "--no-print-directory", "help"], cwd=ROOT, text=True)
    listed = dict(re.findall(r"^  make (\S+) +(\S.*)$", output, re.MULTILINE))
    assert rules == targets
    assert set(listed) == targets


def test_references_to_missing_files_are_found(tmp_path):
    page = tmp_path / "page.md"
    page.write_text(
        "[gone](gone.md), `src/coframe/gone.py`, [here](page.md), `src/coframe/{buffer,gone}`, `tests/*.py`"
    )
    command = [sys.executable, ROOT / "scripts" / "check_paths.py"]
    result = subprocess.run([*command, page], capture_output=True, text=True, check=False)
    assert result.returncode == 1
    assert [line.rpartition(f"{page}:1: ")[2] for line in result.stdout.splitlines()] == [
        "gone.md: no such file",
        "src/coframe/gone.py: no such file",
        "src/coframe/{buffer,gone}: no such file",
    ]


def test_forms_for_issues_name_commands_that_exist():
    yaml = pytest.importorskip("yaml")
    from coframe.cli.app import app

    for path in (ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml"):
        assert yaml.safe_load(path.read_text("utf-8"))
        for command in re.findall(r"`coframe (\w+)", path.read_text("utf-8")):
            assert command in app.commands
