"""What every test may ask for."""

import itertools
import os
from pathlib import Path

import pytest

_domain_ids = itertools.count(os.getpid() % 97)


@pytest.fixture
def domain_id(monkeypatch: pytest.MonkeyPatch) -> int:
    """A DDS domain of this test's own, also set as ROS_DOMAIN_ID for this process and its children."""
    number = 1 + next(_domain_ids) % 200
    monkeypatch.setenv("ROS_DOMAIN_ID", str(number))
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    return number


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of recordings and samples beside the project; the test skips where it is absent."""
    folder = Path(__file__).resolve().parents[2] / "shared"
    if not folder.is_dir():
        pytest.skip("no folder `shared` beside the project: recordings and wire samples are not there")
    return folder
