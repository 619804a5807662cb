# SPDX-License-Identifier: Apache-2.0
"""The lab as a course: folders for students, a simulated robot around their nodes, and their grades."""

from coframe._process.graded_programs import refuse_graded

refuse_graded(__name__)
