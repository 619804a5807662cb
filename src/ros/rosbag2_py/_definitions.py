# SPDX-License-Identifier: Apache-2.0
"""LocalMessageDefinitionSource: the definitions of message types as text."""

from __future__ import annotations

from dataclasses import dataclass

from coframe.messages.definition_texts import definition_of

__all__ = ["LocalMessageDefinitionSource", "MessageDefinition"]


@dataclass
class MessageDefinition:
    """The definition of a type. The encoding is ``ros2msg``, or ``unknown`` if there is none."""

    topic_type: str = ""
    encoding: str = "unknown"
    encoded_message_definition: str = ""
    type_hash: str = ""


class LocalMessageDefinitionSource:
    """Finds definitions of coframe's types and of those in the user's packages."""

    def get_full_text(self, root_type: str) -> MessageDefinition:
        """Return the definition of a type with those of all types inside it."""
        text = definition_of(root_type)
        return MessageDefinition(root_type, "ros2msg" if text else "unknown", text)
