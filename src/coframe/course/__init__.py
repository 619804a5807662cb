# SPDX-License-Identifier: Apache-2.0
"""The lab as a course: folders for students, a simulated robot around their nodes, and grades for what they publish."""
