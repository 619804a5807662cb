# SPDX-License-Identifier: Apache-2.0
"""Functions that actions and substitutions share."""

from launch.utilities.class_tools import is_a, is_a_subclass, isclassinstance
from launch.utilities.create_futures import create_future
from launch.utilities.ensure_argument_type_impl import ensure_argument_type
from launch.utilities.normalizing import (
    normalize_to_list_of_entities,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from launch.utilities.visiting import visit_all_entities_and_collect_futures

__all__ = [
    "create_future",
    "ensure_argument_type",
    "is_a",
    "is_a_subclass",
    "isclassinstance",
    "normalize_to_list_of_entities",
    "normalize_to_list_of_substitutions",
    "perform_substitutions",
    "visit_all_entities_and_collect_futures",
]
