# SPDX-License-Identifier: Apache-2.0
"""The types of parameters in launch files, before and after their normalization."""

from __future__ import annotations

from typing import Any, TypeAlias

__all__ = [
    "EvaluatedParameterValue",
    "EvaluatedParameters",
    "ParameterName",
    "ParameterValue",
    "Parameters",
    "ParametersDict",
    "SomeParameterFile",
    "SomeParameterName",
    "SomeParameterValue",
    "SomeParameters",
    "SomeParametersDict",
]

SomeParameterFile: TypeAlias = Any
SomeParameterName: TypeAlias = Any
SomeParameterValue: TypeAlias = Any
SomeParametersDict: TypeAlias = dict[Any, Any]
SomeParameters: TypeAlias = Any
ParameterName: TypeAlias = tuple[Any, ...]
ParameterValue: TypeAlias = Any
ParametersDict: TypeAlias = dict[ParameterName, Any]
Parameters: TypeAlias = list[Any]
EvaluatedParameterValue: TypeAlias = Any
EvaluatedParameters: TypeAlias = list[Any]
