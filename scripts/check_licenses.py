# SPDX-License-Identifier: Apache-2.0
"""Check that the packages of `coframe[all,remote]` that are installed have licenses that allow any use."""

import re
import sys
from importlib import metadata

from packaging.requirements import Requirement

# In metadata, licenses are SPDX expressions, classifiers or free text.
ALLOWED = re.compile(
    r"\b(MIT|BSD|0BSD|Apache|ISC|PSF|Python Software Foundation|Zlib|CC0|MPL|Mozilla Public|EPL|HPND|Unlicense)",
    re.IGNORECASE,
)
# Packages whose metadata do not name the license that their files contain.
READ_BY_HAND = {
    "apsw": "any license that the OSI approves",
    "xacro": "BSD-3-Clause",
}


def license_of(name: str) -> str:
    """Return what the metadata of an installed package say about its license."""
    data = metadata.metadata(name)
    classifiers = [text for text in data.get_all("Classifier") or [] if text.startswith("License ::")]
    return data.get("License-Expression") or "; ".join([(data.get("License") or "")[:200], *classifiers])


def dependencies(name: str, extras: set[str]) -> set[str]:
    """Return the installed packages that a package needs, directly and indirectly."""
    found: set[str] = set()
    pending = [(name, extra) for extra in {"", *extras}]
    done = set(pending)
    while pending:
        package, extra = pending.pop()
        for text in _requirements(package):
            needed = Requirement(text)
            if needed.marker is not None and not needed.marker.evaluate({"extra": extra}):
                continue
            found.add(needed.name.lower())
            new = {(needed.name.lower(), other) for other in {"", *needed.extras}} - done
            done |= new
            pending += new
    return found - {name}


def _requirements(package: str) -> list[str]:
    """Return what an installed package needs; nothing for one that is not installed, such as adlfs."""
    try:
        return metadata.requires(package) or []
    except metadata.PackageNotFoundError:
        return []


def _is_installed(package: str) -> bool:
    return any(True for _ in metadata.distributions(name=package))


def main() -> int:
    """Print the packages whose license is not on the list; return their number."""
    refused = 0
    names = sorted(filter(_is_installed, dependencies("coframe", {"all", "remote"})))
    for name in names:
        text = READ_BY_HAND.get(name) or license_of(name)
        if name not in READ_BY_HAND and not ALLOWED.search(text):
            shown = " ".join(text.split()) or "unknown"
            print(f"{name}: its license {shown!r} is not on the list in this script")
            refused += 1
    print(f"licenses: {len(names)} packages, {refused} refused")
    return min(refused, 1)


if __name__ == "__main__":
    sys.exit(main())
