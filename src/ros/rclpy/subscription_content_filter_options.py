# SPDX-License-Identifier: Apache-2.0
"""Options of content filters, with which the middleware drops messages before they reach a subscription."""

from typing import NamedTuple

__all__ = ["ContentFilterOptions"]


class ContentFilterOptions(NamedTuple):
    """A filter of messages. coframe has no content filters: `create_subscription` rejects the options."""

    filter_expression: str
    expression_parameters: list[str]
