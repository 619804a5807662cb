# SPDX-License-Identifier: Apache-2.0
"""The substitution of a name that is unique."""

from __future__ import annotations

import os
import re
import secrets
import socket
import sys
from typing import TYPE_CHECKING, Any

from launch.frontend.arguments import check_arguments
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["AnonName"]


@expose_substitution("anon")
class AnonName(Substitution):
    """A name with a suffix that makes it unique. The same name gives the same result in one launch."""

    def __init__(self, name: SomeSubstitutionsType) -> None:
        self.__name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(anon NAME)``."""
        check_arguments("anon", data, 1, 1)
        return cls, {"name": data[0]}

    @property
    def name(self) -> list[Substitution]:
        """The name without its suffix."""
        return self.__name

    def describe(self) -> str:
        """Return a one-line description."""
        return f"AnonName({' + '.join(part.describe() for part in self.name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the unique name."""
        name = perform_substitutions(context, self.__name)
        key = "anon" + name
        if key not in context.launch_configurations:
            parts = (name, socket.gethostname(), os.getpid(), secrets.randbelow(sys.maxsize))
            # Names of nodes consist of letters, digits and underscores.
            context.launch_configurations[key] = re.sub(r"[^A-Za-z0-9_]", "_", "_".join(map(str, parts)))
        unique: str = context.launch_configurations[key]
        return unique
