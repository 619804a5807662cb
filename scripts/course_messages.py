# SPDX-License-Identifier: Apache-2.0
"""Update the catalogues of the course in src/coframe/course/locale: new messages are added, obsolete ones removed.

`python scripts/course_messages.py de` updates German, or creates a new language; `--check` only
reports what is missing or obsolete. The messages are the sentences and f-strings of the grader, the stubs and the
handbook.
"""

from __future__ import annotations

import argparse
import ast
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from coframe.course.handbook import contents
from coframe.course.translation.catalogue import DOMAINS, FOLDER, languages, messages, write_po
from coframe.course.translation.documents import is_prose, translate_markdown, translate_program

if TYPE_CHECKING:
    from collections.abc import Iterator

SOURCE = Path(__file__).resolve().parents[1] / "src" / "coframe"
COURSE = SOURCE / "course"
MODULES = (
    *sorted((COURSE / "criteria").glob("*.py")),
    *(
        COURSE / f"{name}.py"
        for name in ("_program", "_confinement", "_sheet", "_world", "assignment", "checking", "class_folder")
    ),
    *(COURSE / f"{name}.py" for name in ("faults", "first_output", "folders", "formats", "isolation")),
    *(COURSE / f"{name}.py" for name in ("rubric", "running", "submitted")),
    SOURCE / "doctor" / "pose_mistakes.py",
    SOURCE / "doctor" / "quaternion_causes.py",
    SOURCE / "doctor" / "checks" / "late_listeners.py",
)
# Here only the arguments of Language.text and Language.label are shown to students.
CALLERS = (
    *(SOURCE / "cli" / name for name in ("lab.py", "lab_class.py")),
    COURSE / "handbook.py",
    COURSE / "translation" / "language.py",
)
# Arguments of these functions are not shown, and neither are values of these names.
_NO_TEXT = {"compile", "module_program", "replace", "rpartition", "write"}
_NO_TEXT_NAMES = {"_FAILURES", "_UNKNOWN_FRAME"}
_CODE = ("import ", "coframe.", "<", "nan", "xyz", "replace", "pass", "fail")
_SENTENCE = re.compile(
    r"[A-Za-z]{2,}[^<>]* [^<>]*[A-Za-z]|[A-Za-z]+ \{\d+\}|[a-z]{4,}:? ?\{\d+\}"
    r"|\{\d+\}[^<>]* [A-Za-z]{2,}|\{\d+\} [a-z]+"
)


def template(node: ast.AST) -> str:
    """Return a string or an f-string with numbered placeholders."""
    if isinstance(node, ast.Constant):
        return str(node.value)
    assert isinstance(node, ast.JoinedStr)
    parts, number = [], 0
    for part in node.values:
        if isinstance(part, ast.Constant):
            parts.append(str(part.value))
        else:
            parts.append(f"{{{number}}}")
            number += 1
    return "".join(parts)


class Sentences(ast.NodeVisitor):
    """Collects the sentences of a module. The methods are those of the base class, for each kind of node."""

    def __init__(self) -> None:
        self.found: list[str] = []
        self._is_inner = False

    def _add(self, node: ast.AST) -> None:
        text = template(node)
        if text.startswith(_CODE):
            return
        if _SENTENCE.search(text) or (self._is_inner and re.fullmatch(r"[A-Za-z]{3,}:?(?: \{0\})?", text)):
            self.found.append(text.strip().lstrip("; "))

    def visit_Constant(self, node: ast.Constant) -> None:  # noqa: D102 - of the base class
        if isinstance(node.value, str):
            self._add(node)

    def visit_JoinedStr(self, node: ast.JoinedStr) -> None:  # noqa: D102 - of the base class
        self._add(node)
        parts = (part.value for part in node.values if isinstance(part, ast.FormattedValue))
        self.visit_words([part for part in parts if isinstance(part, ast.IfExp | ast.BoolOp | ast.Call)])

    def visit_Call(self, node: ast.Call) -> None:  # noqa: D102 - of the base class
        name = getattr(node.func, "attr", getattr(node.func, "id", ""))
        if name in {"label", "Fault"}:  # a word of a form; the name of a fault, and its explanation
            self.visit_words(node.args[:2])
        elif name not in _NO_TEXT:
            self.generic_visit(node)

    def visit_IfExp(self, node: ast.IfExp) -> None:  # noqa: D102 - of the base class
        self.visit_words([node.body, node.orelse])

    def visit_words(self, nodes: list[ast.expr]) -> None:
        """Visit expressions in which a single word is also a message."""
        outer, self._is_inner = self._is_inner, True
        for node in nodes:
            self.visit(node)
        self._is_inner = outer

    def visit_keyword(self, node: ast.keyword) -> None:  # noqa: D102 - of the base class
        if node.arg not in _NO_TEXT_NAMES:
            self.generic_visit(node)

    def visit_Assign(self, node: ast.Assign) -> None:  # noqa: D102 - of the base class
        if not any(getattr(target, "id", "") in _NO_TEXT_NAMES for target in node.targets):
            self.generic_visit(node)

    def visit_AnnAssign(self, node: ast.AnnAssign) -> None:  # noqa: D102 - of the base class
        if node.value is not None:
            self.visit(node.value)

    def visit_Expr(self, node: ast.Expr) -> None:  # noqa: D102 - of the base class
        if not isinstance(node.value, ast.Constant):
            self.generic_visit(node)

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:  # noqa: D102 - of the base class
        for child in node.body:
            self.visit(child)

    def visit_Subscript(self, node: ast.Subscript) -> None:  # noqa: D102 - of the base class
        self.visit(node.value)

    def visit_Compare(self, node: ast.Compare) -> None:  # noqa: D102 - of the base class
        pass


def grader_messages() -> Iterator[str]:
    """Yield the sentences of the grader."""
    for path in MODULES:
        visitor = Sentences()
        visitor.visit(ast.parse(path.read_text(encoding="utf-8")))
        yield from visitor.found
    for path in CALLERS:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
        spoken = {
            argument.id
            for call in calls
            for argument in call.args
            if _is_shown(call) and isinstance(argument, ast.Name)
        }
        assigned = [node for node in ast.walk(tree) if isinstance(node, ast.Assign)]
        values = [node.value for node in assigned if getattr(node.targets[0], "id", "") in spoken]
        visitor = Sentences()
        shown = [call for call in calls if _is_shown(call)]
        arguments = [argument for call in shown for argument in (*call.args, *(each.value for each in call.keywords))]
        visitor.visit_words(arguments + values)
        yield from visitor.found


def _is_shown(call: ast.Call) -> bool:
    name = getattr(call.func, "attr", getattr(call.func, "id", ""))
    return name in ({"text", "label"} if isinstance(call.func, ast.Attribute) else {"_MisuseError"})


def stub_messages() -> Iterator[str]:
    """Yield the units of the files for students."""
    found: list[str] = []

    def note(unit: str) -> str:
        if unit.startswith("```") or is_prose(unit):  # translate_markdown passes only blocks with words
            found.append(unit)
        return unit

    for path in sorted((COURSE / "templates").glob("*.in")):
        translate = translate_markdown if path.name == "README.md.in" else translate_program
        translate(path.read_text(encoding="utf-8"), note)
    yield from found


def handbook_messages() -> Iterator[str]:
    """Yield the units of the chapters, and the texts of their figures."""
    found: list[str] = []

    def note(unit: str) -> str:
        found.append(unit)
        return unit

    folder = contents().parent
    for path in [contents(), *sorted(folder.glob("[0-9][0-9]_*.md"))]:
        translate_markdown(path.read_text(encoding="utf-8"), note)
    for path in sorted(folder.glob("*.svg")):
        texts = re.findall(r"(?<=>)[^<>]+(?=</(?:text|tspan|title|desc)>)", path.read_text(encoding="utf-8"))
        found += [text for text in texts if is_prose(text)]
    yield from found


def all_messages() -> dict[str, list[str]]:
    """Return the messages of each domain, each once, in the order of the sources."""
    sources = {"grader": grader_messages, "stubs": stub_messages, "handbook": handbook_messages}
    return {domain: list(dict.fromkeys(sources[domain]())) for domain in DOMAINS}


def language_code(text: str) -> str:
    """Return a code, which becomes the name of a folder."""
    if not re.fullmatch(r"[a-z]{2,3}", text):
        raise argparse.ArgumentTypeError(f"{text!r} is not the code of a language, such as de")
    return text


def main() -> int:
    """Update or check the catalogues."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "language", nargs="*", type=language_code, default=[code for code in languages() if code != "en"]
    )
    parser.add_argument("--check", action="store_true", help="only report missing and obsolete messages")
    options = parser.parse_args()
    status = 0
    for code in options.language:
        for domain, wanted in all_messages().items():
            known = dict(messages(code, domain))
            missing = [message for message in wanted if message not in known]
            obsolete = [message for message in known if message not in wanted]
            print(f"{code} {domain}: {len(wanted)} messages, {len(missing)} missing, {len(obsolete)} obsolete")
            if options.check:
                for message in (*missing, *obsolete):
                    print(f"  {message!r}")
                status |= bool(missing or obsolete)
                continue
            folder = FOLDER / code / "LC_MESSAGES"
            folder.mkdir(parents=True, exist_ok=True)
            entries = {message: known.get(message, "") for message in wanted}
            (folder / f"{domain}.po").write_text(write_po(code, entries), encoding="utf-8")
    return status


if __name__ == "__main__":
    sys.exit(main())
