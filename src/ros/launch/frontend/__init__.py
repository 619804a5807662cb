# SPDX-License-Identifier: Apache-2.0
"""The common base of the parsers of XML and YAML launch files."""

from launch.frontend.entity import Entity
from launch.frontend.expose import expose_action, expose_substitution
from launch.frontend.parser import InvalidFrontendLaunchFileError, Parser

__all__ = ["Entity", "InvalidFrontendLaunchFileError", "Parser", "expose_action", "expose_substitution"]
