# SPDX-License-Identifier: Apache-2.0
"""Contracts: files that state what a good recording of a robot contains, for checks in CI.

Example:
    >>> from coframe.contract import parse_contract
    >>> contract = parse_contract("topics: [{name: /scan, type: sensor_msgs/msg/LaserScan, min_rate: 8}]")
    >>> contract.topics[0].min_rate
    8.0
"""

from coframe.contract._checks import Result, check_contract
from coframe.contract._contract import (
    AvailabilityRequirement,
    Contract,
    IgnoredCode,
    TopicRequirement,
    TransformRequirement,
)
from coframe.contract._derivation import derive_contract
from coframe.contract._measurement import MeasuredTopic, Measurement, Pace, measure_live, measure_recording
from coframe.contract._quantities import parse_tolerance
from coframe.contract._reading import parse_contract, read_contract
from coframe.contract._verdict import Verdict, check_recording
from coframe.contract._writing import contract_yaml

__all__ = [
    "AvailabilityRequirement",
    "Contract",
    "IgnoredCode",
    "MeasuredTopic",
    "Measurement",
    "Pace",
    "Result",
    "TopicRequirement",
    "TransformRequirement",
    "Verdict",
    "check_contract",
    "check_recording",
    "contract_yaml",
    "derive_contract",
    "measure_live",
    "measure_recording",
    "parse_contract",
    "parse_tolerance",
    "read_contract",
]


def __dir__() -> list[str]:
    return sorted(__all__)
