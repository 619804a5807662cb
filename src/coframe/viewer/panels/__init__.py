# SPDX-License-Identifier: Apache-2.0
"""The panels next to the scene: curves, one message, the log, and the graph of nodes and topics."""

from coframe.viewer.panels.panels import Panels

__all__ = ["Panels"]
