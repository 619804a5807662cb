# SPDX-License-Identifier: Apache-2.0
"""Verdicts in the formats that CI systems show."""

from coframe.contract.rendering.github import as_annotations
from coframe.contract.rendering.junit import as_junit
from coframe.contract.rendering.markdown import as_markdown
from coframe.contract.rendering.plain import as_data
from coframe.contract.rendering.sarif import as_sarif

__all__ = ["as_annotations", "as_data", "as_junit", "as_markdown", "as_sarif"]
