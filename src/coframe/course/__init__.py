# SPDX-License-Identifier: Apache-2.0
"""The lab as a course: folders for students, a simulated robot around their nodes, and their grades."""

from coframe._process.graded_programs import forbid_graded_program

forbid_graded_program(__name__)
