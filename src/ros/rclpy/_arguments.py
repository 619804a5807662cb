# SPDX-License-Identifier: Apache-2.0
"""Parser of `--ros-args`: remapping rules, parameters and logging."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from rclpy import _yaml
from rclpy.exceptions import RCLInvalidROSArgsError, UnknownROSArgsError
from rclpy.impl.logging_severity import LoggingSeverity

if TYPE_CHECKING:
    from collections.abc import Iterator

_START: Final = "--ros-args"
_END: Final = "--"
_SWITCHES: Final = ("stdout-logs", "rosout-logs", "external-lib-logs")


@dataclass(frozen=True)
class Remap:
    """A remapping rule `[node:]from:=to`.

    `kind` is "name" or "namespace" for a rule about the node itself. Otherwise it is "topic", "service", or "any" for
    both.
    """

    node: str | None
    kind: str
    match: str
    replacement: str


@dataclass(frozen=True)
class ParameterOverride:
    """A parameter value for the nodes whose fully qualified name matches a pattern (`/**` matches all nodes)."""

    node_pattern: str
    name: str
    value: Any

    def matches(self, fully_qualified_name: str) -> bool:
        """Return whether the override applies to the node with this name."""
        pattern = re.escape(self.node_pattern).replace(r"/\*\*", "(/[^/]+)*").replace(r"\*", "[^/]+")
        return re.fullmatch(pattern, fully_qualified_name) is not None


@dataclass
class LoggingArguments:
    """Logging options of the command line."""

    default_level: LoggingSeverity | None = None
    levels: dict[str, LoggingSeverity] = field(default_factory=dict)
    stdout: bool = True
    rosout: bool = True


@dataclass
class Arguments:
    """Parsed ROS arguments."""

    remaps: list[Remap] = field(default_factory=list)
    parameters: list[ParameterOverride] = field(default_factory=list)
    logging: LoggingArguments = field(default_factory=LoggingArguments)


def parse(args: list[str]) -> Arguments:
    """Parse a command line. Arguments outside of `--ros-args ... --` are ignored.

    Raises:
        RCLInvalidROSArgsError: A rule is malformed, or an option has no argument.
        UnknownROSArgsError: An argument is not a ROS argument.
    """
    result = Arguments()
    unknown: list[str] = []
    for section in _sections(args):
        words = iter(section)
        unknown.extend(word for word in words if not _parse_word(word, words, result))
    if unknown:
        raise UnknownROSArgsError(f"Found unknown ROS arguments: {unknown}")
    return result


def remove(args: list[str]) -> list[str]:
    """Return the arguments without `--ros-args ... --`."""
    kept = []
    is_ros_argument = False
    for word in args:
        if word == _START:
            is_ros_argument = True
        elif is_ros_argument and word == _END:
            is_ros_argument = False
        elif not is_ros_argument:
            kept.append(word)
    return kept


def _sections(args: list[str]) -> Iterator[list[str]]:
    section: list[str] | None = None
    for word in args:
        if section is None:
            section = [] if word == _START else None
        elif word == _END:
            yield section
            section = None
        elif word != _START:
            section.append(word)
    if section is not None:
        yield section


def _parse_word(word: str, rest: Iterator[str], result: Arguments) -> bool:
    if word in {"-r", "--remap"}:
        result.remaps.append(_parse_remap(_argument_of(word, rest)))
    elif word in {"-p", "--param"}:
        result.parameters.append(_parse_parameter(_argument_of(word, rest)))
    elif word == "--params-file":
        values = _yaml.load_parameters(_argument_of(word, rest))
        result.parameters.extend(ParameterOverride(*value) for value in values)
    elif word == "--log-level":
        _parse_log_level(_argument_of(word, rest), result.logging)
    elif word in {"--log-config-file", "-e", "--enclave"}:
        _argument_of(word, rest)  # Log files and security enclaves are not supported, so the argument is ignored.
    elif word.startswith("--enable-") and word[len("--enable-") :] in _SWITCHES:
        _switch(word[len("--enable-") :], result.logging, on=True)
    elif word.startswith("--disable-") and word[len("--disable-") :] in _SWITCHES:
        _switch(word[len("--disable-") :], result.logging, on=False)
    elif ":=" in word and not word.startswith("-"):
        result.remaps.append(_parse_remap(word))
    else:
        return False
    return True


def _argument_of(flag: str, rest: Iterator[str]) -> str:
    try:
        return next(rest)
    except StopIteration:
        raise RCLInvalidROSArgsError(f"Failed to parse ROS arguments: {flag} needs an argument") from None


def _switch(name: str, logging: LoggingArguments, *, on: bool) -> None:
    if name == "stdout-logs":
        logging.stdout = on
    elif name == "rosout-logs":
        logging.rosout = on


def _split_rule(rule: str, flag: str) -> tuple[str | None, str, str]:
    """Return node, left side and right side of `[node:]left:=right`."""
    left, separator, right = rule.partition(":=")
    if not separator or not left:
        raise RCLInvalidROSArgsError(f"Failed to parse ROS arguments: {flag} {rule!r} does not have the form from:=to")
    node: str | None = None
    if match := re.match(r"([A-Za-z_]\w*):(?!//)", left):
        node, left = match[1], left[match.end() :]
    return node, left, right


def _parse_remap(rule: str) -> Remap:
    node, match, replacement = _split_rule(rule, "--remap")
    if match in {"__node", "__name"}:
        return Remap(node, "name", match, replacement)
    if match == "__ns":
        return Remap(node, "namespace", match, replacement)
    if not replacement:
        raise RCLInvalidROSArgsError(f"Failed to parse ROS arguments: --remap {rule!r} has no value after :=")
    for scheme, kind in (("rostopic://", "topic"), ("rosservice://", "service")):
        if match.startswith(scheme):
            return Remap(node, kind, match[len(scheme) :], replacement)
    return Remap(node, "any", match, replacement)


def _parse_parameter(rule: str) -> ParameterOverride:
    node, name, text = _split_rule(rule, "--param")
    return ParameterOverride(f"/**/{node}" if node else "/**", name, _yaml.parse_value(text))


def _parse_log_level(text: str, logging: LoggingArguments) -> None:
    name, separator, level_name = text.partition(":=")
    if not separator:
        name, level_name = "", text
    try:
        level = LoggingSeverity[level_name.upper()]
    except KeyError:
        raise RCLInvalidROSArgsError(
            f"Failed to parse ROS arguments: unknown log level in --log-level {text!r}. "
            "Known levels: debug, info, warn, error, fatal"
        ) from None
    if name:
        logging.levels[name] = level
    else:
        logging.default_level = level
