# SPDX-License-Identifier: Apache-2.0
"""`make faults`: faults between real processes, each with a promise, a measurement and a verdict."""
