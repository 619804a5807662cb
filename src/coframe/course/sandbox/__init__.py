# SPDX-License-Identifier: Apache-2.0
"""What confines a student's program: one module for each mechanism of the operating system.

`start` begins each program, in a process that has imported the standard library only. Therefore these modules import
nothing else, and each other by relative names. `coframe.course.confinement` decides what a program may do.
"""
