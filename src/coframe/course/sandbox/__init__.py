# SPDX-License-Identifier: Apache-2.0
"""Confine a student's program, with one module per mechanism of the operating system.

`start` starts each program, in a process that has imported only the standard library. These modules therefore import
nothing else, and use relative imports. `coframe.course._confinement` decides what a program may do.
"""
