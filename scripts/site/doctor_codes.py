# SPDX-License-Identifier: Apache-2.0
"""The page of the doctor's codes: one section per code, from the pages that `coframe doctor --explain` prints."""

from __future__ import annotations

import re

from coframe.doctor import page
from coframe.doctor.codes import built_in_codes

PAGE = "reference/doctor-codes.md"
CODES = built_in_codes()

_HEAD = """# Doctor codes

Every finding of [`coframe doctor`](../how-to/doctor.md) has a code. The codes do not change. `coframe doctor --list`
prints this list, `coframe doctor --explain TF012` one section; the hints of coframe's exceptions refer to the codes.

| code | finding |
|---|---|
"""


def pages() -> dict[str, str]:
    """Return the page, by its path."""
    rows = "".join(f"| [{code}](#{code.lower()}) | {page(code).title} |\n" for code in CODES)
    return {PAGE: _HEAD + rows + "".join(f"\n{_section(code)}\n" for code in CODES)}


def _section(code: str) -> str:
    """Return the section of a code, with its headings one level lower and an anchor that is the code."""
    title, _, text = page(code).text.partition("\n")
    lower = re.sub(r"^## (.*)$", rf"### \1 {{ #{code.lower()}-\1 }}", text.strip(), flags=re.MULTILINE)
    lower = re.sub(r"\{ #([^}]*) \}", lambda match: "{ #" + match[1].lower().replace(" ", "-") + " }", lower)
    return f"## {title.removeprefix('# ')} {{ #{code.lower()} }}\n\n{lower}"
