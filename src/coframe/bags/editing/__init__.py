# SPDX-License-Identifier: Apache-2.0
"""Edit recordings: frame names, topics, stamps, static transforms and more, in one pass over the messages."""

from coframe.bags.editing._edit import DamagedRecordingError, EditReport, RuleCount, edit
from coframe.bags.editing._recipe import RULES, Recipe

__all__ = ["RULES", "DamagedRecordingError", "EditReport", "Recipe", "RuleCount", "edit"]


def __dir__() -> list[str]:
    return sorted(__all__)
