# SPDX-License-Identifier: Apache-2.0
"""The nodes of the tf2 lab.

They import only ROS packages, so each of these files also runs unchanged on a real ROS 2 installation.
"""

from coframe._process.graded_programs import forbid_graded_program

forbid_graded_program(__name__)
