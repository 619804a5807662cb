# SPDX-License-Identifier: Apache-2.0
"""Environments in which coframe is installed as by its wheel, and folders of strangers."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from benchmarks.installed import create
from strangers import PROOF, Environment


@pytest.fixture(scope="session")
def bare(tmp_path_factory: pytest.TempPathFactory) -> Environment:
    """An environment without coframe."""
    return Environment(*create(tmp_path_factory.mktemp("bare") / "env", with_coframe=False))


@pytest.fixture(scope="session")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Environment:
    """An environment with coframe as its wheel installs it."""
    return Environment(*create(tmp_path_factory.mktemp("installed") / "env", with_coframe=True))


@pytest.fixture
def proof(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The file that exists after hostile code has run; programs get its path in their environment."""
    path = tmp_path / "proof"
    monkeypatch.setenv(PROOF, str(path))
    return path


@pytest.fixture
def write() -> Callable[[Path, dict[str, str]], Path]:
    def written(folder: Path, files: dict[str, Any]) -> Path:
        for name, text in files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text)
        return folder

    return written
