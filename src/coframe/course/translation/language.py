# SPDX-License-Identifier: Apache-2.0
"""The language of the course: sentences of the grader, stubs and the handbook are translated when they are shown.

Reports are stored in English, so that a class can be graded once and read in several languages. A message of the
catalogue can have placeholders {0}, {1} for the values of the English sentence, which are translated in turn.
"""

from __future__ import annotations

import itertools
import os
import re
from functools import cached_property
from typing import TYPE_CHECKING

from coframe.course.translation.catalogue import languages, messages
from coframe.course.translation.documents import translate_markdown, translate_program
from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

__all__ = ["ENGLISH", "Language", "choose_language"]

_VARIABLE = "COFRAME_LANGUAGE"
_LOCALE_VARIABLES = ("LC_ALL", "LC_MESSAGES", "LANG")  # of gettext; the first one that is set counts
_PLACEHOLDER = re.compile(r"\{(\d+)\}")
_SEPARATORS = ("; ", ". ", ", ", " and ")
_MAX_DEPTH = 4
_MAX_LENGTH = 1000  # characters; the search for a longer sentence, which contains a student's text, takes too long
_NAMED = re.compile(r"(\S+: )(.+)", re.DOTALL)  # such as "lidar_link: no transform"
_WORDS = re.compile(r"[^,] ")  # several words that are not a list
_JOINTS = ";, \n"  # before a part of a sentence
_SHORT = 6  # characters, with spaces


class Language:
    """A language of the course.

    Attributes:
        code: Its code, such as "de".
    """

    def __init__(self, code: str) -> None:
        self.code = code

    def text(self, sentence: str) -> str:
        """Return a sentence of the grader in this language, or the sentence itself if it has no translation."""
        if self.code == ENGLISH.code or not sentence.strip() or len(sentence) > _MAX_LENGTH:
            return sentence
        return self._text(sentence, 0) or sentence

    def has(self, sentence: str) -> bool:
        """Return whether a sentence has a translation, which may be equal to it."""
        return bool(self._text(sentence, 0))

    def label(self, word: str) -> str:
        """Return a word of the forms around the sentences, such as "expected"."""
        return messages(self.code, "grader").get(word, word)

    def markdown(self, text: str) -> str:
        """Return a chapter of the handbook in this language."""
        return self._document(text, "handbook", translate_markdown)

    def figure(self, svg: str) -> str:
        """Return a figure of the handbook with its texts in this language."""
        known = messages(self.code, "handbook")
        return re.sub(r"(?<=>)[^<>]+(?=<)", lambda text: known.get(text[0], text[0]), svg)

    def stub(self, name: str, text: str) -> str:
        """Return a file for students in this language.

        Args:
            name: The name of the file.
            text: Its content, with the placeholders of the assignment.
        """
        return self._document(text, "stubs", translate_markdown if name.endswith(".md") else translate_program)

    def _document(self, text: str, domain: str, translate: Callable[[str, Callable[[str], str]], str]) -> str:
        if self.code == ENGLISH.code:
            return text
        known = messages(self.code, domain)
        return translate(text, lambda unit: known.get(unit, unit))

    @cached_property
    def _exact(self) -> Mapping[str, str]:
        """The translations without placeholders, without the differences that sentences may have."""
        known = messages(self.code, "grader").items()
        return {_bare(message): text for message, text in known if not _PLACEHOLDER.search(message)}

    @cached_property
    def _templates(self) -> list[tuple[re.Pattern[str], str, bool]]:
        """The translations with placeholders and whether their fixed text is short; those with the most of it first."""
        known = [(message, text) for message, text in messages(self.code, "grader").items() if "{0}" in message]
        known.sort(key=lambda pair: len(_fixed(pair[0])), reverse=True)
        return [(_pattern(_bare(message)), text, len(_fixed(message)) <= _SHORT) for message, text in known]

    def _text(self, sentence: str, depth: int) -> str:
        """Return the translation of a sentence, or "" if it has none or is nested too deeply."""
        if depth > _MAX_DEPTH:
            return ""
        found = self._exact.get(_bare(sentence)) or self._from_parts(sentence, depth, _SEPARATORS[:2])
        found = found or self._from_template(sentence, depth) or self._from_parts(sentence, depth, _SEPARATORS[2:])
        if not found and (named := _NAMED.fullmatch(sentence)) and (part := self._text(named[2], depth + 1)):
            return named[1] + part
        return _like(sentence, found) if found else ""

    def _from_template(self, sentence: str, depth: int) -> str:
        for pattern, text, is_short in self._templates:
            if match := pattern.fullmatch(_bare(sentence)):
                values = [self._text(value, depth + 1) or value for value in match.groups()]
                if is_short and any(map(_WORDS.search, values)):
                    continue  # "{0} of {1}" also fits other sentences.
                return _PLACEHOLDER.sub(lambda place, values=values: values[int(place[1])], text)  # type: ignore[misc]
        return ""

    def _from_parts(self, sentence: str, depth: int, separators: tuple[str, ...]) -> str:
        """Return the translation of several sentences, or of the words of a list, if all of them have one."""
        for separator in separators:
            parts = sentence.split(separator) if separator in sentence else []
            # The first part without a translation ends the search: a student's text can have many parts.
            found = list(itertools.takewhile(bool, (self._text(part, depth + 1) for part in parts)))
            if parts and len(found) == len(parts):
                return (f" {self.label('and')} " if separator == " and " else separator).join(found)
        return ""


ENGLISH = Language("en")


def _bare(sentence: str) -> str:
    """Return a sentence as it is compared: the grader changes its first letter and its full stop."""
    text = sentence.lstrip(_JOINTS).rstrip(". \n")
    return text[:1].lower() + text[1:]


def _like(sentence: str, found: str) -> str:
    """Return a translation with the first letter, the beginning and the full stop of the English sentence."""
    text = found.lstrip(_JOINTS).rstrip(".") + ("." if sentence.rstrip().endswith(".") else "")
    begin = len(sentence) - len(sentence.lstrip(_JOINTS))
    is_capital = sentence[begin : begin + 1].isupper()
    return sentence[:begin] + (text[:1].upper() + text[1:] if is_capital else text)


def _fixed(message: str) -> str:
    """Return the text of a message without its placeholders."""
    return _PLACEHOLDER.sub("", message)


def _pattern(message: str) -> re.Pattern[str]:
    parts = _PLACEHOLDER.split(message)
    return re.compile(
        "".join("(.*?)" if number % 2 else re.escape(part) for number, part in enumerate(parts)), re.DOTALL
    )


def choose_language(code: str | None = None, recorded_code: str = "") -> Language:
    """Return the language with a code, or that of COFRAME_LANGUAGE, of a folder, or of the locale, else English.

    Args:
        code: The code that the user gives, such as "de".
        recorded_code: The code in a student's folder; it has no effect if there is no such language.

    Raises:
        CourseError: There is no language with the code, or that of COFRAME_LANGUAGE.
    """
    known = languages()
    locale = next(filter(None, map(os.environ.get, _LOCALE_VARIABLES)), "")
    if asked := code or os.environ.get(_VARIABLE, ""):
        if _short(asked) not in known:
            raise CourseError(f"The course has no language {asked!r}.", hint=f"Languages: {', '.join(known)}.")
        return Language(_short(asked))
    return next((Language(each) for each in (_short(recorded_code), _short(locale)) if each in known), ENGLISH)


def _short(locale: str) -> str:
    """Return the language of a locale, such as "de" of "de_AT.UTF-8"."""
    return re.split(r"[_.@-]", locale, maxsplit=1)[0].lower()
