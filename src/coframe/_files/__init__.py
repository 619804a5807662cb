# SPDX-License-Identifier: Apache-2.0
"""Files that may be damaged, hostile or incomplete: how they are read with bounds, and how they are written."""
