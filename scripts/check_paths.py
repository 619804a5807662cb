# SPDX-License-Identifier: Apache-2.0
"""Report references to files that do not exist: links and paths in tracked Markdown files, and paths in comments.

Example:
    python scripts/check_paths.py              check all tracked files
    python scripts/check_paths.py README.md    check these files only
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from tracked_files import chosen

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = "benchmarks|conformance|distributions|docs|examples|interfaces|middlewares|native|scripts|src|tests|viewer"
# A path of the repository: it begins with one of its folders, and its last part is a file or a folder.
PATH = re.compile(rf"(?<![\w./-])(?:{FOLDERS})/[\w./*{{}},-]*[\w}}*]")
LINK = re.compile(r"\]\((?!\w+:|#)([^)\s#]+)")
FENCE = re.compile(r"^([ \t]*)(```+|~~~+).*?^\1\2", re.MULTILINE | re.DOTALL)
SKIPPED = ("CHANGELOG.md", "docs/reliability-log.md", "src/ros/", "interfaces/", "viewer/node_modules/")
# Made by a build, or an example of a name.
NOT_TRACKED = re.compile(
    r"NAME|LANGUAGE|PACKAGE|\{package\}|\bTF0\d\d\b|viewer/node_modules|/_bundled\b|^scripts/(?:a|old)\.py$|/X\b"
)


def main() -> int:
    """Check the files, and return the exit code."""
    found = [line for path in chosen(sys.argv[1:]) if is_checked(path) for line in problems(path)]
    print(*found, sep="\n", end="\n" if found else "")
    if found:
        print(f"{len(found)} references to files that do not exist", file=sys.stderr)
    return 1 if found else 0


def is_checked(path: str) -> bool:
    """Return whether the references of a file are checked: logs name files as they were."""
    return path.endswith((".md", ".py", ".yml", ".toml", ".sh", "Makefile")) and not path.startswith(SKIPPED)


def problems(path: str) -> list[str]:
    """Return one line for each reference of a file that leads nowhere."""
    text = (ROOT / path).read_text("utf-8", errors="replace")
    found = []
    if path.endswith(".md"):
        prose = FENCE.sub(lambda match: "\n" * match[0].count("\n"), text)
        folder = (ROOT / path).parent
        found += [
            (match.start(), match[1], prose) for match in LINK.finditer(prose) if not (folder / match[1]).exists()
        ]
    lines = text if path.endswith(".md") else "\n".join(map(comment, text.splitlines()))
    found += [(match.start(), match[0], lines) for match in PATH.finditer(lines) if not exists(match[0], path)]
    return [f"{path}:{where.count(chr(10), 0, start) + 1}: {name}: no such file" for start, name, where in found]


def comment(line: str) -> str:
    """Return the comment of a line of code, "" if it has none: strings may name files of tests."""
    return line[line.index("# ") :] if "# " in line and "http" not in line else ""


def exists(name: str, path: str) -> bool:
    """Return whether a path of the repository exists; braces and asterisks stand for several."""
    if NOT_TRACKED.search(name):
        return True
    name = name.rstrip(".")
    if re.search(r"\*\*[^/]|[^/]\*\*", name):
        return False  # pathlib accepts ** only between slashes
    alternatives = re.search(r"\{([\w,./-]*)\}", name)
    if alternatives:
        return all(exists(name.replace(alternatives[0], each, 1), path) for each in alternatives[1].split(","))
    bases = (ROOT, (ROOT / path).parent, ROOT / "viewer", ROOT / "src" / "coframe")
    return any(next(base.glob(name), None) is not None for base in bases)


if __name__ == "__main__":
    sys.exit(main())
