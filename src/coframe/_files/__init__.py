# SPDX-License-Identifier: Apache-2.0
"""Read files that may be damaged, hostile or incomplete with bounds, and write files completely or not at all."""
