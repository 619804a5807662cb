# SPDX-License-Identifier: Apache-2.0
"""Tables of message fields and frame poses at the stamps of a topic or at a fixed rate."""

from coframe.bags.tables.columns import METHODS, Column, ColumnLike, Method
from coframe.bags.tables.files import TABLE_FORMATS, table_format, write_table
from coframe.bags.tables.query import TableQuery
from coframe.bags.tables.table import Table, TableColumn, TableValue

__all__ = [
    "METHODS",
    "TABLE_FORMATS",
    "Column",
    "ColumnLike",
    "Method",
    "Table",
    "TableColumn",
    "TableQuery",
    "TableValue",
    "table_format",
    "write_table",
]
