# SPDX-License-Identifier: Apache-2.0
"""The pytest fixture `check_contract`; load it with ``pytest_plugins = ["coframe.contract.pytest_fixture"]``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from coframe.contract._reading import read_contract
from coframe.contract._verdict import check_recording

if TYPE_CHECKING:
    import os
    from collections.abc import Callable

__all__ = ["check_contract"]


@pytest.fixture(scope="session")
def check_contract() -> Callable[..., None]:
    """Return a function that fails the test if a recording violates the contract in a file."""

    def check(contract: str | os.PathLike[str], *recordings: str | os.PathLike[str]) -> None:
        required = read_contract(contract)
        verdicts = [check_recording(required, path) for path in recordings]
        failures = [verdict.text() for verdict in verdicts if not verdict.is_kept]
        if failures:
            pytest.fail("\n".join(failures), pytrace=False)

    return check
