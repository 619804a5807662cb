# SPDX-License-Identifier: Apache-2.0
"""Folders of students, and their grades."""

import shutil

import pytest

pytest.importorskip("dds_library", reason="the nodes of a folder speak DDS")

from grades import SOLUTION  # of this folder

from coframe.course.checking import check_folder


@pytest.fixture
def folder(tmp_path):
    """A copy of the reference solution."""
    shutil.copytree(SOLUTION, tmp_path / "lab")
    return tmp_path / "lab"


@pytest.fixture
def grade(folder):
    """Grade the folder, or another one; return the criteria by their file."""

    def check(*only, of=folder, **options):
        report = check_folder(of, only=only, **options) if only else check_folder(of, **options)
        return {criterion["file"]: criterion for criterion in report["criteria"]}

    return check
