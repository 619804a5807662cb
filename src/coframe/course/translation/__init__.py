# SPDX-License-Identifier: Apache-2.0
"""The course in other languages: catalogues of gettext, and how sentences and documents are translated with them."""
