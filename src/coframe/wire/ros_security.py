# SPDX-License-Identifier: Apache-2.0
"""The environment variables with which ROS 2 requests security (SROS 2), and what happens where there is none."""

from __future__ import annotations

import logging
import os
from typing import TYPE_CHECKING, Final

from coframe._output.warn_once import WarnOnce
from coframe.errors import WireError

if TYPE_CHECKING:
    from collections.abc import Mapping

ENABLE: Final = "ROS_SECURITY_ENABLE"
STRATEGY: Final = "ROS_SECURITY_STRATEGY"

_warn_once = WarnOnce(logging.getLogger("coframe.wire").warning)


def is_enabled(environment: Mapping[str, str] = os.environ) -> bool:
    """Return whether security is requested.

    Raises:
        WireError: The variable has an invalid value.
    """
    return _choice(environment, ENABLE, ("false", "true")) == "true"


def is_enforced(environment: Mapping[str, str] = os.environ) -> bool:
    """Return whether a process must not communicate without the requested security.

    Raises:
        WireError: The variable has an invalid value.
    """
    return _choice(environment, STRATEGY, ("Permissive", "Enforce")) == "Enforce"


def report_missing(reason: str, remedy: str, environment: Mapping[str, str] = os.environ) -> None:
    """Warn once that this process communicates without the requested security.

    Args:
        reason: Why there is none, as a phrase.
        remedy: What to do.
        environment: The environment variables.

    Raises:
        WireError: Security is enforced.
    """
    if is_enforced(environment):
        raise WireError(f"{ENABLE} is true, but {reason}.", hint=remedy)
    _warn_once(
        f"{ENABLE} is true, but {reason}: this process communicates without security. {STRATEGY}=Enforce refuses that."
    )


def report_unsupported(middleware: str, environment: Mapping[str, str] = os.environ) -> None:
    """Do what `report_missing` does if security is requested over a middleware on which coframe has none.

    Args:
        middleware: The name of the middleware.
        environment: The environment variables.

    Raises:
        WireError: A variable has an invalid value, or security is requested and enforced.
    """
    if is_enabled(environment):
        report_missing(
            f"coframe has no security over {middleware}",
            f"Use Fast DDS (the package coframe-fastdds and COFRAME_WIRE=fastdds), or unset {ENABLE}.",
            environment,
        )


def _choice(environment: Mapping[str, str], name: str, values: tuple[str, ...]) -> str:
    """Return a variable that has one of some values; the first one if it is not set.

    ROS 2 takes any other value for the first one, which disables the protection without a word.
    """
    value = environment.get(name, "").strip() or values[0]
    if value not in values:
        raise WireError(
            f"{name} is {value!r}: it must be {values[0]} or {values[1]}.",
            hint=f"Unset it for the default, {values[0]}.",
        )
    return value
