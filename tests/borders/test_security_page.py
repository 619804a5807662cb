# SPDX-License-Identifier: Apache-2.0
"""The page about security: each test that it names exists."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_the_named_tests_exist():
    page = (ROOT / "docs/reference/security.md").read_text(encoding="utf-8")
    named = re.findall(r"`(tests/[\w./]+)`", page)
    assert len(named) > 10
    assert [name for name in named if not (ROOT / name).exists()] == []
