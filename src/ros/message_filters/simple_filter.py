# SPDX-License-Identifier: Apache-2.0
"""The module in which upstream defines `SimpleFilter`."""

from message_filters._filters import SimpleFilter

__all__ = ["SimpleFilter"]
