# SPDX-License-Identifier: Apache-2.0
"""Catalogues of gettext: PO files, read without compiling them, so that a translator sees a change immediately."""

from __future__ import annotations

import ast
import gettext
import io
import re
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["DOMAINS", "FOLDER", "Catalogue", "languages", "messages", "write_po"]

# Each language has a folder LANGUAGE/LC_MESSAGES here, with a file DOMAIN.po for each domain.
FOLDER = Path(__file__).resolve().parents[1] / "locale"
DOMAINS = ("grader", "stubs", "handbook")
_PLACEHOLDER = re.compile(r"\{\d+\}|@[A-Z0-9_]+@")
_KEYWORDS = ("msgid", "msgstr")
_HEADER = "# SPDX-License-Identifier: Apache-2.0\n"


class Catalogue(gettext.NullTranslations):
    """The translations of one PO file. Fuzzy and empty entries count as missing.

    Attributes:
        messages: The translation of each message.
    """

    messages: dict[str, str]

    def _parse(self, fp: Any) -> None:
        self.messages = {}
        for entry in fp.read().split("\n\n"):
            fields, is_fuzzy = _fields(entry)
            if fields.get("msgid") and fields.get("msgstr") and not is_fuzzy:
                self.messages[fields["msgid"]] = fields["msgstr"]

    def gettext(self, message: str) -> str:
        """Return the translation of a message, or the message itself."""
        return self.messages.get(message, message)


def _fields(entry: str) -> tuple[dict[str, str], bool]:
    """Return the texts of an entry by their keyword, and whether the translation has to be reviewed."""
    fields: dict[str, str] = {}
    keyword, is_fuzzy = "", False
    for line in entry.splitlines():
        if line.startswith("#"):
            is_fuzzy = is_fuzzy or (line.startswith("#,") and "fuzzy" in line)
            continue
        word, _, quoted = line.partition(" ")
        if word in _KEYWORDS:
            keyword = word
        elif line.startswith('"'):
            quoted = line
        else:
            continue
        fields[keyword] = fields.get(keyword, "") + str(ast.literal_eval(quoted))
    return fields, is_fuzzy


@cache
def messages(language: str, domain: str) -> Mapping[str, str]:
    """Return the translations of a domain; none if the language has no file for it.

    Raises:
        CourseError: The file is damaged, or a translation has other placeholders than its message.
    """
    path = FOLDER / language / "LC_MESSAGES" / f"{domain}.po"
    if not path.is_file():
        return {}
    try:
        found = Catalogue(io.StringIO(path.read_text(encoding="utf-8"))).messages  # type: ignore[arg-type]
    except (ValueError, SyntaxError) as error:
        raise CourseError(f"The catalogue {path} is damaged: {error}", hint="Check it with msgfmt -c.") from None
    for message, text in found.items():
        if sorted(_PLACEHOLDER.findall(message)) != sorted(_PLACEHOLDER.findall(text)):
            raise CourseError(
                f"The catalogue {path} is damaged: {text!r} has other placeholders than {message!r}.",
                hint="Use each placeholder of the message once.",
            )
    return found


def languages() -> list[str]:
    """Return the languages of the course, English first."""
    return ["en", *sorted(path.parent.name for path in FOLDER.glob("*/LC_MESSAGES"))]


def write_po(language: str, entries: Mapping[str, str]) -> str:
    """Return the text of a PO file.

    Args:
        language: The language, such as "de".
        entries: The translation of each message, "" if it is missing.
    """
    header = f"Language: {language}\nContent-Type: text/plain; charset=UTF-8\nContent-Transfer-Encoding: 8bit\n"
    blocks = [f'{_HEADER}msgid ""\nmsgstr {_quoted(header)}\n']
    blocks += [f"msgid {_quoted(message)}\nmsgstr {_quoted(text)}\n" for message, text in entries.items()]
    return "\n".join(blocks)


def _quoted(text: str) -> str:
    """Return a text as the strings of a PO file, one per line of the text."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    lines = [f'"{line}"' for line in escaped.replace("\n", "\\n\n").splitlines()] or ['""']
    return lines[0] if len(lines) == 1 else "\n".join(['""', *lines])
