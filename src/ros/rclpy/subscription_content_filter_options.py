# SPDX-License-Identifier: Apache-2.0
"""Options of content filters, which let only some messages on a topic through to the callback of a subscription."""

from functools import partial
from typing import NamedTuple

from rclpy import _absent

__all__ = ["ContentFilterOptions"]


class ContentFilterOptions(NamedTuple):
    """A filter of messages, in the language of DDS.

    Attributes:
        filter_expression: A condition on fields, such as ``pose.x > %0 AND name LIKE 'arm%'``. It has comparisons
            (``= <> != < <= > >=``), ``LIKE``, ``BETWEEN ... AND ...``, ``AND``, ``OR``, ``NOT`` and parentheses.
        expression_parameters: The values of ``%0``, ``%1`` and so on, as literals: ``"1.5"``, ``"'text'"``.
    """

    filter_expression: str
    expression_parameters: list[str]


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
