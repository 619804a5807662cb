# SPDX-License-Identifier: Apache-2.0
"""Parser of `--ros-args`: remapping rules, parameters and logging."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from rclpy import _yaml
from rclpy.exceptions import NameValidationException, RCLInvalidROSArgsError, UnknownROSArgsError, _with_hint
from rclpy.impl.logging_severity import LoggingSeverity
from rclpy.validate_namespace import validate_namespace
from rclpy.validate_node_name import validate_node_name

if TYPE_CHECKING:
    from collections.abc import Iterator

_START: Final = "--ros-args"
_END: Final = "--"
_DEPRECATED_REMAP: Final = r"(?!\d)(?:\w+:)?[~/]?[\w{}]+(?:/[\w{}]+)*:=[~/]?[\w{}/]+"
_NAME: Final = r"(?!__)[A-Za-z_][A-Za-z0-9_]*"
# Slashes are accepted anywhere in a part: the parameter of the QoS of a topic is qos_overrides./scan.publisher.depth.
_PART: Final = rf"(?:/+(?:{_NAME}(?:/+{_NAME})*/*)?|{_NAME}(?:/+{_NAME})*/*)"
_PARAMETER: Final = rf"(?:(?P<node>{_NAME}):)?(?P<name>{_PART}(?:\.{_PART})*)"
_SWITCHES: Final = ("stdout-logs", "rosout-logs", "external-lib-logs")


# The names in a remapping rule, as rcl's lexer reads them.
_REMAP_PART = r"[A-Za-z_](?:(?<!_)_|[A-Za-z0-9])*"
_REMAP_NAME = rf"(?:~/|/)?{_REMAP_PART}(?:/{_REMAP_PART})*"

Parameters = dict[str, dict[str, Any]]  # values by pattern of node names and name of the parameter


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
    """A parameter value for the nodes whose fully qualified name matches a pattern.

    `*` in the pattern is one name, `**` any number of names: `/**` matches all nodes.
    """

    node_pattern: str
    name: str
    value: Any

    def matches(self, fully_qualified_name: str) -> bool:
        """Return whether the override applies to the node with this name."""
        return _yaml.is_match(self.node_pattern, fully_qualified_name)


@dataclass
class LoggingArguments:
    """Logging options of the command line."""

    default_level: LoggingSeverity | None = None
    levels: dict[str, LoggingSeverity] = field(default_factory=dict)
    stdout: bool = True
    rosout: bool = True
    config_file: str | None = None


@dataclass
class Arguments:
    """Parsed ROS arguments.

    `deprecated_remaps` are the remapping rules without `--ros-args`, which ROS 2 still obeys.
    """

    remaps: list[Remap] = field(default_factory=list)
    parameters: list[ParameterOverride] = field(default_factory=list)
    logging: LoggingArguments = field(default_factory=LoggingArguments)
    deprecated_remaps: list[str] = field(default_factory=list)


def parse(args: list[str]) -> Arguments:
    """Parse a command line. Of the arguments outside of `--ros-args ... --`, only remapping rules are used.

    Raises:
        RCLInvalidROSArgsError: A rule is malformed, or an option has no argument.
        UnknownROSArgsError: An argument is not a ROS argument.
    """
    result = Arguments()
    parameters: Parameters = {}
    unknown: list[str] = []
    for section in _sections(args):
        words = iter(section)
        unknown.extend(word for word in words if not _parse_word(word, words, result, parameters))
    if unknown:
        raise _with_hint(
            UnknownROSArgsError(str(unknown)),
            "These arguments after --ros-args are unknown. Write the program's own arguments before --ros-args.",
        )
    result.deprecated_remaps = [word for word in remove(args) if _parse_deprecated_remap(word, result)]
    result.parameters = [
        ParameterOverride(node, *item) for node, values in parameters.items() for item in values.items()
    ]
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


def _parse_word(word: str, rest: Iterator[str], result: Arguments, parameters: Parameters) -> bool:
    if word in {"-r", "--remap"}:
        result.remaps.append(_parse_remap(_argument_of(word, "remap rule", rest), word))
    elif word in {"-p", "--param"}:
        _merge(parameters, _parse_parameter(_argument_of(word, "parameter override rule", rest), word))
    elif word == "--params-file":
        _merge(parameters, _parse_parameter_file(_argument_of(word, "file path", rest)))
    elif word == "--log-level":
        _parse_log_level(_argument_of(word, "log level", rest), result.logging)
    elif word == "--log-config-file":
        result.logging.config_file = _argument_of(word, "file path", rest)
    elif word in {"-e", "--enclave"}:
        _argument_of(word, "enclave path", rest)  # Security enclaves are not supported, so the argument is ignored.
    elif word.startswith("--enable-") and word[len("--enable-") :] in _SWITCHES:
        _switch(word[len("--enable-") :], result.logging, on=True)
    elif word.startswith("--disable-") and word[len("--disable-") :] in _SWITCHES:
        _switch(word[len("--disable-") :], result.logging, on=False)
    elif ":=" in word and not word.startswith("-"):
        result.remaps.append(_parse_remap(word, "--remap"))
    else:
        return False
    return True


def _argument_of(flag: str, what: str, rest: Iterator[str]) -> str:
    try:
        return next(rest)
    except StopIteration:
        found = "provided" if what.endswith(("path", "level")) else "found"
        error = RCLInvalidROSArgsError(f"Couldn't parse trailing {flag} flag. No {what} {found}.")
        raise _with_hint(error, f"Write {flag} ARGUMENT.") from None


def _switch(name: str, logging: LoggingArguments, *, on: bool) -> None:
    if name == "stdout-logs":
        logging.stdout = on
    elif name == "rosout-logs":
        logging.rosout = on


def _split_rule(rule: str) -> tuple[str | None, str, str]:
    """Return node, left side and right side of `[node:]left:=right`."""
    left, separator, right = rule.partition(":=")
    if not separator or not left:
        raise ValueError("it does not have the form from:=to")
    node: str | None = None
    if match := re.match(r"([A-Za-z_]\w*):(?!//)", left):
        node, left = match[1], left[match.end() :]
    return node, left, right


def _parse_remap(rule: str, flag: str) -> Remap:
    try:
        return _remap_of(rule)
    except (ValueError, NameValidationException) as error:
        raise RCLInvalidROSArgsError(f"Couldn't parse remap rule: '{flag} {rule}'. Error: {error}") from None


def _remap_of(rule: str) -> Remap:
    node, match, replacement = _split_rule(rule)
    if match in {"__node", "__name"}:
        validate_node_name(replacement)
        return Remap(node, "name", match, replacement)
    if match == "__ns":
        validate_namespace(replacement)
        return Remap(node, "namespace", match, replacement)
    if not replacement:
        raise ValueError("it has no value after :=")
    kind = "any"
    for scheme, kind_of_scheme in (("rostopic://", "topic"), ("rosservice://", "service")):
        if match.startswith(scheme):
            kind, match = kind_of_scheme, match[len(scheme) :]
    for name, side in ((match, "before"), (replacement, "after")):
        if not re.fullmatch(_REMAP_NAME, name, re.ASCII):
            raise ValueError(
                f"{name!r} {side} := is not a name: names consist of letters, digits and single '_', do not start with "
                "a digit, and are separated by single '/'; only '/' or '~/' can be before the first one"
            )
    return Remap(node, kind, match, replacement)


def _parse_deprecated_remap(word: str, result: Arguments) -> bool:
    """Add the rule of a word outside of `--ros-args`. Return False if the word is not a rule."""
    if not re.fullmatch(_DEPRECATED_REMAP, word):
        return False
    try:
        result.remaps.append(_remap_of(word))
    except (ValueError, NameValidationException):
        return False
    return True


def _merge(parameters: Parameters, values: Parameters) -> None:
    """Add values. As in rcl, all values of a node have the place of the first one: later nodes override them."""
    for node, of_node in values.items():
        parameters.setdefault(node, {}).update(of_node)


def _parse_parameter(rule: str, flag: str) -> Parameters:
    try:
        return _parameter_of(rule)
    except ValueError as error:
        text = f"Couldn't parse parameter override rule: '{flag} {rule}'. Error: {error}"
        raise RCLInvalidROSArgsError(text) from None


def _parameter_of(rule: str) -> Parameters:
    left, separator, text = rule.partition(":=")
    if not separator or not left:
        raise ValueError("it does not have the form name:=value")
    if not text:
        raise ValueError("it has no value after :=. An empty string is written as x:=\"''\"")
    found = re.fullmatch(_PARAMETER, left)
    if found is None:
        raise ValueError(
            "the name of a parameter consists of letters, digits and '_', starts with a letter or one '_', and its "
            "parts are separated by dots. The name of a node and a colon can precede it"
        )
    return {found["node"] or "/**": {found["name"]: _yaml.parse_value(text)}}


def _parse_parameter_file(path: str) -> Parameters:
    try:
        return _yaml.load_parameters(path)
    except (OSError, ValueError) as error:
        text = "Error opening YAML file" if isinstance(error, OSError) else str(error)
        hint = f"{error.strerror}: {path}" if isinstance(error, OSError) else "The format is that of `ros2 param dump`."
        problem = RCLInvalidROSArgsError(f"Couldn't parse params file: '--params-file {path}'. Error: {text}")
        raise _with_hint(problem, hint) from None


def _parse_log_level(text: str, logging: LoggingArguments) -> None:
    name, separator, level_name = text.partition(":=")
    if not separator:
        name, level_name = "", text
    try:
        level = LoggingSeverity[level_name.upper()]
    except KeyError:
        error = RCLInvalidROSArgsError(
            f"Couldn't parse log level: '--log-level {text}'. Error: Argument does not use a valid severity level"
        )
        raise _with_hint(error, "Known levels: debug, info, warn, error, fatal.") from None
    if name:
        logging.levels[name] = level
    else:
        logging.default_level = level
