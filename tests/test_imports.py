# SPDX-License-Identifier: Apache-2.0
"""The direction of imports is checked, and an import in the wrong direction is reported."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("importlinter", reason="the contracts are checked by import-linter")

ROOT = Path(__file__).parents[1]


@pytest.fixture
def sources(tmp_path):
    """A copy of the package's Python files that a test may change."""
    folder = tmp_path / "coframe"
    shutil.copytree(ROOT / "src", folder / "src", ignore=shutil.ignore_patterns("static", "__pycache__", "*.so"))
    shutil.copy(ROOT / "pyproject.toml", folder)
    return folder


def lint(folder):
    program = ROOT / "scripts" / "check_imports.py"
    return subprocess.run([sys.executable, program, folder], capture_output=True, text=True, check=False)


def test_the_contracts_hold_in_a_folder_of_any_name(sources):
    result = lint(sources)
    assert result.returncode == 0, result.stdout


UPWARD = {
    "coframe.analysis.tree": "coframe.doctor.observation",
    "coframe.wire.participant": "coframe.tf_relay",
    "coframe.wire.endpoints": "coframe.wire.participant",
    "coframe.bags.recording": "coframe.cli.bag",
}


def test_each_import_of_a_higher_layer_and_each_module_without_a_layer_is_reported(sources):
    for lower, upper in UPWARD.items():
        with (sources / "src" / f"{lower.replace('.', '/')}.py").open("a", encoding="utf-8") as file:
            file.write(f"\nimport {upper}\n")
    (sources / "src" / "coframe" / "new_part.py").write_text("", encoding="utf-8")
    result = lint(sources)
    assert result.returncode == 1
    for lower, upper in UPWARD.items():
        assert f"{lower} -> {upper} (l." in result.stdout
    assert "- coframe.new_part\n" in result.stdout
