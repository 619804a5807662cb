# SPDX-License-Identifier: Apache-2.0
"""The direction of imports is checked, and an import in the wrong direction is reported."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("importlinter", reason="the contracts are checked by import-linter")

ROOT = Path(__file__).parents[1]
LINT = "import sys; from importlinter.cli import lint_imports; sys.exit(lint_imports(no_cache=True))"


@pytest.fixture(scope="module")
def sources(tmp_path_factory):
    """A copy of the package's Python files that a test may change."""
    folder = tmp_path_factory.mktemp("sources")
    shutil.copytree(ROOT / "src", folder / "src", ignore=shutil.ignore_patterns("static", "__pycache__", "*.so"))
    shutil.copy(ROOT / "pyproject.toml", folder)
    return folder


def lint(folder):
    paths = [str(folder / "src"), str(folder / "src" / "ros")]
    # -S keeps the editable installation out of the way; the other packages still have to be found.
    packages = [path for path in sys.path if path.endswith("site-packages")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([*paths, *packages])}
    return subprocess.run(
        [sys.executable, "-S", "-c", LINT], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )


def test_the_contracts_hold(sources):
    result = lint(sources)
    assert result.returncode == 0, result.stdout


@pytest.mark.parametrize(
    ("lower", "upper"),
    [
        ("coframe.analysis.tree", "coframe.doctor.observation"),
        ("coframe.wire.participant", "coframe.tf_relay"),
        ("coframe.wire.endpoints", "coframe.wire.participant"),
        ("coframe.bags.recording", "coframe.cli.bag"),
    ],
)
def test_an_import_of_a_higher_layer_is_reported(sources, lower, upper):
    file = sources / "src" / f"{lower.replace('.', '/')}.py"
    text = file.read_text(encoding="utf-8")
    file.write_text(f"{text}\nimport {upper}\n", encoding="utf-8")
    try:
        result = lint(sources)
        assert result.returncode == 1
        assert lower in result.stdout
        assert upper in result.stdout
    finally:
        file.write_text(text, encoding="utf-8")
