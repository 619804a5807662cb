# SPDX-License-Identifier: Apache-2.0
"""The pages of the commands, from the command line's own objects: what `coframe COMMAND --help` prints, as tables."""

from __future__ import annotations

import contextlib
import io
import re
from typing import Any, NamedTuple

from coframe.cli.app import app
from coframe.cli.commands import COMMANDS

_FOLDER = "reference/commands"
# Groups of commands, in the order in which a user meets them.
GROUPS = {
    "Look at transforms": ("view", "frames", "echo", "lookup", "monitor"),
    "Find errors": ("doctor", "why"),
    "Publish transforms": ("static", "robot", "joints", "relay", "demo"),
    "Recordings": ("record", "play", "bag", "trajectory", "compare", "plot", "cloud", "batch"),
    "Programs and packages": ("launch", "run", "router", "hub", "lab"),
    "Commands of ros2": ("topic", "node", "service", "action", "param", "lifecycle", "interface", "pkg", "ros2"),
}
# The names of the pages in the navigation: their headings also say what the command does.
NAMES = {f"{_FOLDER}/{name}.md": f"coframe {name}" for name in app.commands}
_INDEX = """# Commands

Every command prints this description with `--help`. Install them with `pip install 'coframe[all]'`. Ctrl-C stops a
command with exit code 130; invalid arguments give exit code 2.
"""


class Help(NamedTuple):
    """The parts of a help text: the usage, the paragraphs of the description, and entries by section."""

    usage: str
    paragraphs: list[str]
    sections: dict[str, list[tuple[str, str]]]


def pages() -> dict[str, str]:
    """Return the pages, by their paths."""
    known = set(app.commands)
    ungrouped = tuple(sorted(known - {name for names in GROUPS.values() for name in names}))
    pages = {f"{_FOLDER}/{name}.md": _page(name, app.commands[name]) for name in known}
    index = _INDEX
    for title, names in {**GROUPS, "Other commands": ungrouped}.items():
        rows = "".join(f"| [`coframe {name}`]({name}.md) | {_summary(name)} |\n" for name in names if name in known)
        index += f"\n## {title}\n\n| command | what it does |\n|---|---|\n{rows}" if rows else ""
    pages[f"{_FOLDER}/index.md"] = index
    return pages


def _summary(name: str) -> str:
    return _escape(COMMANDS[name].line) if name in COMMANDS else ""


def _title(name: str) -> str:
    """Return the heading of a command, which is what a result of the search shows."""
    summary = _summary(name).partition(", like ")[0].rstrip(".")
    return f"coframe {name}: {summary[0].lower()}{summary[1:]}" if summary else f"coframe {name}"


def _page(name: str, command: Any) -> str:
    parts = [f"# {_title(name)}", *_body(f"coframe {name}")]
    for word in getattr(command, "commands", {}):
        parts += [f"## coframe {name} {word}", *_body(f"coframe {name} {word}")]
    return "\n\n".join(parts) + "\n"


def _body(path: str) -> list[str]:
    """Return the blocks of one command: description, usage, example, arguments and options."""
    text = parse(_help_text(path))
    blocks = []
    for paragraph in text.paragraphs:
        example = re.match(r"Examples?: (.*)", paragraph, re.DOTALL)
        blocks.append(
            f'```console title="Example"\n{example[1]}\n```' if example else _escape(" ".join(paragraph.split()))
        )
    blocks.insert(1, f'```text title="Usage"\n{text.usage}\n```')
    for title, entries in text.sections.items():
        if title == "Commands":
            rows = [(f"[`{word}`](#{path.replace(' ', '-')}-{word})", line) for word, line in entries]
        else:
            rows = [(f"`{word.replace('|', '¦')}`", line) for word, line in entries]
        head = "| | |\n|---|---|\n" if title == "Arguments" else f"| {title.lower().rstrip('s')} | |\n|---|---|\n"
        blocks.append(f"**{title}**\n\n{head}" + "\n".join(f"| {word} | {_escape(line)} |" for word, line in rows))
    return blocks


def _help_text(path: str) -> str:
    """Return what the command prints with --help; some commands write it themselves."""
    output = io.StringIO()
    with contextlib.redirect_stdout(output), contextlib.suppress(SystemExit):
        app.main([*path.split()[1:], "--help"], prog_name="coframe")
    return output.getvalue()


def parse(text: str) -> Help:
    """Return the parts of a help text in the layout of `coframe.cli.help_format`."""
    blocks = [block for block in re.split(r"\n\s*\n", text.strip("\n")) if block.strip()]
    usage = re.sub(r"^Usage: |^ {7}", "", blocks[0], flags=re.MULTILINE)
    paragraphs, sections = [], {}
    for block in blocks[1:]:
        title = re.match(r"(\w+):\n", block)
        if title:
            sections[title[1]] = _entries(block[title.end() :])
        else:
            paragraphs.append("\n".join(line[2:] for line in block.splitlines()))
    return Help(usage, paragraphs, sections)


def _entries(block: str) -> list[tuple[str, str]]:
    """Return the entries of a section: a name after two spaces, its text two spaces behind it, or below it."""
    entries: list[list[str]] = []
    for line in block.splitlines():
        if re.match(r"  \S", line):
            name, _, description = line.strip().partition("  ")
            entries.append([name, description.strip()])
        elif entries:
            entries[-1][1] = f"{entries[-1][1]} {line.strip()}".strip()
    return [(name, description) for name, description in entries]


def _escape(text: str) -> str:
    """Return text as Markdown in a table: no cell ends, no HTML, no emphasis by accident."""
    # A word between colons would become an emoji.
    return re.sub(r":(?=\w+:)", "&#58;", re.sub(r"([|<>*_\[\]`])", r"\\\1", text))
