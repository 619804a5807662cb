# SPDX-License-Identifier: Apache-2.0
"""Write a contract as YAML that people read and edit: a requirement per line, and comments about the units."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from coframe.contract._quantities import DEFAULT_TOLERANCE, duration_text, tolerance_text
from coframe.contract._reading import VERSION

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.contract._contract import (
        AvailabilityRequirement,
        Contract,
        TopicRequirement,
        TransformRequirement,
    )

__all__ = ["contract_yaml"]


def contract_yaml(contract: Contract, *, source: str = "") -> str:
    """Return a contract as a YAML document.

    Args:
        contract: The contract.
        source: The name of the recording from which it was derived, for the first comment.
    """
    tolerances = [each.tolerance for each in contract.transforms if each.static]
    tolerance = max(tolerances, key=tolerances.count, default=DEFAULT_TOLERANCE)
    severity = "never" if contract.fail_on is None else str(contract.fail_on)
    lines = [
        f"# What a good recording contains{f', derived from {_comment(source)}' if source else ''}.",
        "# Check recordings:  coframe contract check RUN.mcap -c contract.yaml",
        f"version: {VERSION}",
        f"clock: {contract.clock}  # of the stamps: wall, simulated or any",
        f"other_frames: {'allowed' if contract.other_frames else 'forbidden'}  # frames that are not listed below",
        f"tolerance: {tolerance_text(tolerance)}  # of xyz and rpy",
        "",
        "# Rates in Hz; xyz in meters, and rpy in radians (roll, pitch, yaw about the fixed axes).",
        *_list("transforms", (_transform(each, tolerance) for each in contract.transforms)),
        "",
        *_list("topics", map(_topic, contract.topics)),
        "",
        "# The transform from source to target at the stamp of each message must be available within this time of its",
        "# arrival, for this share of the messages.",
        *_list("availability", map(_availability, contract.availability)),
        "",
        "# The findings of `coframe doctor` that break the contract: error, warning, note or never.",
        "findings:",
        f"  fail_on: {severity}",
        *(f"  {line}" for line in _list("ignore", ({"code": e.code, "reason": e.reason} for e in contract.ignore))),
    ]
    return "\n".join(lines) + "\n"


def _list(key: str, entries: Iterable[dict[str, Any]]) -> list[str]:
    lines = [f"  - {{{', '.join(f'{name}: {_value(value)}' for name, value in entry.items())}}}" for entry in entries]
    return [f"{key}:", *lines] if lines else [f"{key}: []"]


def _transform(requirement: TransformRequirement, tolerance: tuple[float, float]) -> dict[str, Any]:
    return _present(
        parent=requirement.parent,
        child=requirement.child,
        namespace=requirement.namespace or None,
        static=requirement.static or None,
        xyz=requirement.xyz,
        rpy=requirement.rpy,
        tolerance=tolerance_text(requirement.tolerance)
        if requirement.static and requirement.tolerance != tolerance
        else None,
        min_rate=requirement.min_rate,
        max_gap=None if requirement.max_gap is None else duration_text(requirement.max_gap),
    )


def _topic(requirement: TopicRequirement) -> dict[str, Any]:
    return _present(
        name=requirement.name,
        type=requirement.type or None,
        frame=requirement.frame or None,
        min_rate=requirement.min_rate,
        max_gap=None if requirement.max_gap is None else duration_text(requirement.max_gap),
        reliable=requirement.reliable or None,
        transient_local=requirement.transient_local or None,
    )


def _availability(requirement: AvailabilityRequirement) -> dict[str, Any]:
    return _present(
        target=requirement.target,
        source=requirement.source,
        namespace=requirement.namespace or None,
        at=requirement.at,
        within=duration_text(requirement.within),
        share=f"{requirement.share * 100:.6g}%",
    )


def _present(**values: Any) -> dict[str, Any]:
    return {name: value for name, value in values.items() if value is not None}


def _value(value: Any) -> str:
    """Return a value in YAML's flow style; JSON is a part of YAML."""
    if isinstance(value, tuple):
        return f"[{', '.join(map(_number, value))}]"
    return _number(value) if isinstance(value, float) else json.dumps(value)


def _number(value: float) -> str:
    """Return a number without an exponent, because YAML 1.1 reads 1e-05 as a string."""
    digits = f"{value:.9f}".rstrip("0")
    return f"{digits}0" if digits.endswith(".") else digits


def _comment(text: str) -> str:
    return "".join(letter if letter.isprintable() else "?" for letter in text)
