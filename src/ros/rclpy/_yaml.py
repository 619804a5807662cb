# SPDX-License-Identifier: Apache-2.0
"""Parser of parameter files and of parameter values on the command line, compatible with rcl's parser."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

from coframe._files.bounded_yaml import MAX_BYTES, yaml_events
from coframe._files.other_files import BEGINNING_SIZE, describe_other_kind
from coframe._files.regular_files import read_regular
from coframe._process.optional_imports import pip_install
from rclpy._parameter_words import parse_scalar

if TYPE_CHECKING:
    from collections.abc import Iterable

_STRING_TAG: Final = "tag:yaml.org,2002:str"
_KEY: Final = "ros__parameters"
_WILDCARD_OR_NAME: Final = r"[A-Za-z_][A-Za-z0-9_]*|\*\*?"
_TYPE_NAMES: Final = {bool: "bool", int: "integer", float: "double", str: "string"}

# Values without any special rule of YAML, which are read without PyYAML. Python compiles the patterns when they are
# used: it takes 7 ms, and most programs have no parameters on the command line.
_PART: Final = r"[A-Za-z0-9_./+~$^;=\xa1-\u1fff-][A-Za-z0-9_./+~$^;=:@%#!*()<>\xa1-\u1fff-]*(?<!:)"
_WORD: Final = rf"(?![-.]*(?: |$|,))(?!---|\.\.\.)(?!- )(?:{_PART}(?: +{_PART})*)"
_QUOTED: Final = r"""'(?:[^'\n\r]|'')*'|"[^"\\\n\r]*\""""
_ITEM: Final = rf"(?:{_QUOTED}|{_WORD})"
_SIMPLE: Final = rf" *(?:{_ITEM}|\[ *(?:{_ITEM} *(?:, *{_ITEM} *)*,? *)?\]) *"


def parse_value(text: str) -> Any:
    """Return the typed value of the text after `name:=`: a scalar, or a list of scalars of one type.

    Raises:
        ValueError: The text is not valid YAML, is a mapping, or is a list with several types.
    """
    if re.fullmatch(_SIMPLE, text):
        words = [_simple_scalar(word) for word in re.findall(_ITEM, text)]
        return _of_one_type(words, 1) if text.lstrip(" ").startswith("[") else words[0]
    value = _Value()
    for event in _events(text):
        kind = type(event).__name__
        if kind == "ScalarEvent":
            value.add(event)
        elif kind == "SequenceStartEvent":
            value.begin_list()
        elif kind == "SequenceEndEvent":
            value.end_list()
        elif kind in {"MappingStartEvent", "AliasEvent"}:
            raise ValueError(f"{text!r} is a mapping or an alias of YAML. Expected one value, or a list in brackets")
    return value.value


def load_parameters(path: str) -> dict[str, dict[str, Any]]:
    """Read a parameter file.

    Returns:
        Values by pattern of node names and name of the parameter. Blocks of the same node are merged in their order.

    Raises:
        OSError: The file cannot be read.
        ValueError: It is not a parameter file, exceeds a limit, or PyYAML is not installed.
    """
    text = read_regular(path, MAX_BYTES)
    # Such files are valid YAML without parameters: a node would start with its defaults. An empty one is, too, in rcl.
    if text and (what := describe_other_kind(text[:BEGINNING_SIZE])):
        raise ValueError(what)
    reader = _FileReader()
    for event in _events(text):
        getattr(reader, f"on_{type(event).__name__}", _ignore)(event)
    return reader.nodes


def is_match(pattern: str, node: str) -> bool:
    """Return whether a fully qualified name matches a pattern: `*` is one name in it, `**` any number of names."""
    parts = re.escape(f"/{pattern.removeprefix('/')}").replace(r"/\*\*", "(/[^/]+)*").replace(r"\*", "[^/]+")
    return re.fullmatch(parts, f"/{node.removeprefix('/')}") is not None


def _events(text: str | bytes) -> Iterable[Any]:
    try:
        return yaml_events(text)
    except ImportError:
        raise ValueError(f"reading it needs the package PyYAML: {pip_install('params')}") from None


def _ignore(_event: Any) -> None:
    """Streams and documents have no meaning of their own: rcl reads all documents of a file."""


def _simple_scalar(word: str) -> bool | int | float | str:
    if word[0] == "'":
        return word[1:-1].replace("''", "'")
    return word[1:-1] if word[0] == '"' else parse_scalar(word)


def _scalar(event: Any) -> bool | int | float | str:
    is_quoted = event.style in {"'", '"'}
    if not event.value and not is_quoted:
        raise ValueError(f"No value at line {_line(event)}")
    text: str = event.value.partition("\0")[0]  # as in C
    return text if is_quoted or event.tag == _STRING_TAG else parse_scalar(text)


def _line(event: Any) -> int:
    line: int = event.start_mark.line
    return line + 1


def _of_one_type(values: list[Any], line: int) -> list[Any]:
    for value in values:
        if type(value) is not type(values[0]):
            kind = _TYPE_NAMES[type(value)]
            raise ValueError(f"Sequence should be of same type. Value type '{kind}' do not belong at line_num {line}")
    return values


class _Value:
    """The value of a parameter from the events of YAML. Lists in lists are no part of ROS: the last one counts."""

    def __init__(self) -> None:
        self.value: Any = None
        self.is_list = False
        self._items: list[Any] = []

    def begin_list(self) -> None:
        self.is_list = True
        self._items = []
        if self.value is None:
            self.value = self._items

    def end_list(self) -> None:
        self.is_list = False

    def add(self, event: Any) -> None:
        scalar = _scalar(event)
        if not self.is_list:
            self.value = scalar
            return
        self._items.append(scalar)
        _of_one_type([self._items[0], scalar], _line(event))
        self.value = self._items


class _Namespace:
    """Names joined by a separator. The last part is removed, which is what rcl does for names with separators."""

    def __init__(self, separator: str) -> None:
        self.text = ""
        self.depth = 0
        self._separator = separator

    def add(self, name: str) -> None:
        self.text += name if not self.depth or self.text.endswith(self._separator) else self._separator + name
        self.depth += 1

    def replace(self, text: str) -> None:
        self.text = text
        self.depth += 1

    def remove_last(self) -> None:
        if self.depth == 1:
            self.text = ""
        elif self._separator in self.text:
            self.text = self.text.rpartition(self._separator)[0]
        self.depth = max(self.depth - 1, 0)


class _FileReader:
    """Collects the parameters of a file from the events of YAML. The methods are named after the classes of events."""

    def __init__(self) -> None:
        self.nodes: dict[str, dict[str, Any]] = {}
        self._names = _Namespace("/")
        self._prefix = _Namespace(".")
        self._parameters: dict[str, Any] = {}  # of the node of the block
        self._parameter: str | None = None
        self._value = _Value()
        self._depth = 0
        self._is_key = True
        self._is_in_block = False  # below `ros__parameters:`
        self._is_new_mapping = False

    def on_ScalarEvent(self, event: Any) -> None:
        if self._is_key:
            self._on_key(event.value.partition("\0")[0], _line(event))
            self._is_key = False
            return
        self._check_value(event)
        self._value.add(event)
        self._store()
        self._is_key = not self._value.is_list

    def on_SequenceStartEvent(self, event: Any) -> None:
        if self._is_key:
            raise ValueError(f"Sequences cannot be key at line {_line(event)}")
        self._check_value(event)
        self._value.begin_list()
        self._store()

    def on_SequenceEndEvent(self, _event: Any) -> None:
        self._value.end_list()
        self._is_key = True

    def on_MappingStartEvent(self, event: Any) -> None:
        if self._value.is_list:
            raise ValueError(f"Mappings cannot be in lists at line {_line(event)}")
        self._depth += 1
        self._is_key = True
        # The mapping of a block is not that of a parameter.
        self._is_new_mapping = not (self._is_in_block and self._depth - self._names.depth == 2)

    def on_MappingEndEvent(self, _event: Any) -> None:
        if self._is_in_block:
            if self._prefix.depth:
                self._prefix.remove_last()
            else:
                self._is_in_block = False
        elif self._depth == self._names.depth + 1:
            self._names.remove_last()
        self._depth -= 1

    def on_AliasEvent(self, event: Any) -> None:
        raise ValueError(f"Will not support aliasing at line {_line(event)}")

    def _check_value(self, event: Any) -> None:
        if not self._is_in_block or self._parameter is None:
            raise ValueError(f"Cannot have a value before {_KEY} at line {_line(event)}")

    def _store(self) -> None:
        assert self._parameter is not None
        self._parameters[self._parameter] = self._value.value

    def _on_key(self, name: str, line: int) -> None:
        if not name:
            raise ValueError(f"No key at line {line}")
        if self._is_in_block:
            if self._is_new_mapping:
                if self._parameter is None:
                    raise ValueError(f"Expected the name of a parameter at line {line}")
                self._prefix.replace(self._parameter)
                self._is_new_mapping = False
            self._parameter = f"{self._prefix.text}.{name}" if self._prefix.depth else name
            self._value = _Value()
        elif name.startswith(_KEY):
            if not self._names.depth:
                raise ValueError(f"There are no node names before {_KEY} at line {line}")
            _check_node_name(self._names.text, line)
            self._parameters = self.nodes.setdefault(self._names.text, {})
            self._parameter = None
            self._is_in_block = True
        else:
            self._names.add(name)


def _check_node_name(name: str, line: int) -> None:
    """Raise ValueError if a name is neither a node name nor a pattern with `*` and `**` as parts."""
    for part in name.removeprefix("/").split("/"):
        if not re.fullmatch(_WILDCARD_OR_NAME, part):
            raise ValueError(
                f"{name!r} above line {line} is not the name of a node. The parts between slashes must be '*', '**', "
                "or letters, digits and '_' without a digit in front"
            )
