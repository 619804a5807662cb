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


@pytest.mark.parametrize("script", ["check_paths.py", "check_words.py"])
def test_a_file_to_check_that_does_not_exist_is_named(script):
    command = [sys.executable, ROOT / "scripts" / script, "absent.md"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (result.returncode, result.stdout) == (1, "")
    assert result.stderr.startswith("absent.md: no such file")


def test_names_with_other_than_ascii_letters_are_checked(tmp_path):
    """git quotes such names, unless it is asked not to."""
    scripts = tmp_path / "scripts"
    scripts.mkdir()
    for name in ("check_words.py", "check_spdx.py", "check_paths.py", "tracked_files.py", "banned_words.toml"):
        (scripts / name).write_bytes((ROOT / "scripts" / name).read_bytes())
    (tmp_path / "für_später.py").write_text(f"# {'men'}ded by tests/{'gone'}.py\n", "utf-8")
    for words in (["init", "--quiet"], ["add", "für_später.py"]):
        subprocess.run(["git", *words], cwd=tmp_path, check=True)
    for script in ("check_words.py", "check_spdx.py", "check_paths.py"):
        result = subprocess.run([sys.executable, scripts / script], capture_output=True, encoding="utf-8", check=False)
        assert result.returncode == 1, script
        assert "für_später.py:" in result.stdout, script


def test_forms_for_issues_name_commands_that_exist():
    yaml = pytest.importorskip("yaml")
    from coframe.cli.app import app

    for path in (ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml"):
        assert yaml.safe_load(path.read_text("utf-8"))
        for command in re.findall(r"`coframe (\w+)", path.read_text("utf-8")):
            assert command in app.commands
