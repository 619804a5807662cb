# SPDX-License-Identifier: Apache-2.0
"""Notebooks of Jupyter, whose packages are imported when a test needs them, because that takes seconds."""

import warnings

import pytest

TIMEOUT = 120.0  # seconds for each cell


def package(name):
    """Return one of Jupyter's packages; skip the test without it."""
    return pytest.importorskip(name, reason=f"tests of notebooks need {name}")


def new_notebook(*cells):
    """Return a notebook with cells of code."""
    new = package("nbformat").v4
    return new.new_notebook(cells=[new.new_code_cell(cell) for cell in cells])


def execute(notebook, folder):
    """Execute the cells of a notebook with a real kernel in a folder; their outputs are in the notebook then."""
    client = package("nbclient").NotebookClient
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of Jupyter's own packages
        client(notebook, timeout=TIMEOUT, resources={"metadata": {"path": str(folder)}}).execute()


def exported(notebook):
    """Return the HTML that nbconvert makes of a notebook."""
    exporter = package("nbconvert").HTMLExporter
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of Jupyter's own packages
        body, _ = exporter(template_name="basic").from_notebook_node(notebook)
    return body
