# SPDX-License-Identifier: Apache-2.0
"""Writes SQLite files page by page, with contents that SQLite itself never writes."""

import struct

PAGE = 512  # bytes
_TOPICS = "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT)"
_MESSAGES = "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)"
_TIME = 1_700_000_000_000_000_000
_FAN_OUT = 40  # pages below a page


def shared_data(path, topic, rows=3000, size=1_000_000):
    """Write a recording whose messages all have the same pages as their data: 1 MB that reads as 3 GB."""
    length = len(_record(None, 1, _TIME, size))
    smallest = (PAGE - 12) * 32 // 255 - 23
    inside = smallest + (length - smallest) % (PAGE - 4)  # bytes of a row that are not on the shared pages
    inside = inside if inside <= PAGE - 35 else smallest
    shared = -(-(length - inside) // (PAGE - 4))
    pages = [struct.pack(">I", 5 + index) + bytes(PAGE - 4) for index in range(shared - 1)] + [bytes(PAGE)]
    cells = [
        (_varint(length) + _varint(row) + _record(None, 1, _TIME + row, size)[:inside] + struct.pack(">I", 4), row)
        for row in range(1, rows + 1)
    ]
    in_leaf = PAGE // (inside + 20)
    level = []
    for start in range(0, rows, in_leaf):
        part = cells[start : start + in_leaf]
        pages.append(_leaf([cell for cell, _ in part]))
        level.append((3 + len(pages), part[-1][1]))
    while len(level) > _FAN_OUT:
        groups = [level[start : start + _FAN_OUT] for start in range(0, len(level), _FAN_OUT)]
        level = []
        for group in groups:
            pages.append(_interior(group))
            level.append((3 + len(pages), group[-1][1]))
    return _write(path, topic, _interior(level), pages)


def endless_rows(path, topic, topic_of_rows=1, levels=15):
    """Write a recording of 10 kB with 40 to the power of 15 rows: each page refers 40 times to the one below."""
    pages = [_leaf([_cell(1, _record(None, topic_of_rows, _TIME, 10))])]
    for _ in range(levels - 1):
        pages.append(_interior([(3 + len(pages), 1)] * _FAN_OUT))
    return _write(path, topic, _interior([(3 + len(pages), 1)] * _FAN_OUT), pages)


def page_in_itself(path, topic):
    """Write a recording with a page that refers to itself."""
    return _write(path, topic, _interior([(3, 1)] * _FAN_OUT), [])


def _varint(number):
    parts = [number & 127]
    while number := number >> 7:
        parts.insert(0, number & 127 | 128)
    return bytes(parts)


def _record(*values):
    """Return a row: NULL, texts and integers; the last integer stands for as many zero bytes."""
    kinds, body = b"", b""
    for index, value in enumerate(values):
        if value is None:
            kinds += _varint(0)
        elif isinstance(value, str):
            kinds, body = kinds + _varint(2 * len(value) + 13), body + value.encode()
        elif index == len(values) - 1:
            kinds, body = kinds + _varint(2 * value + 12), body + bytes(value)
        else:
            kinds, body = kinds + _varint(6), body + struct.pack(">q", value)
    return _varint(len(kinds) + 1) + kinds + body


def _definition(name, page, sql):
    kinds = [_varint(2 * len(text) + 13) for text in ("table", name, name)]
    kinds += [_varint(1), _varint(2 * len(sql) + 13)]
    header = b"".join(kinds)
    return _varint(len(header) + 1) + header + f"table{name}{name}".encode() + bytes([page]) + sql.encode()


def _cell(number, row):
    return _varint(len(row)) + _varint(number) + row


def _leaf(cells, start=0):
    page, end = bytearray(PAGE), PAGE
    for number, cell in enumerate(cells):
        end -= len(cell)
        page[end : end + len(cell)] = cell
        struct.pack_into(">H", page, start + 8 + 2 * number, end)
    struct.pack_into(">BHHHB", page, start, 13, 0, len(cells), end, 0)
    return page


def _interior(children):
    """Return a page that refers to other pages, each with the number of its last row."""
    page, end = bytearray(PAGE), PAGE
    for number, (child, last) in enumerate(children[:-1]):
        cell = struct.pack(">I", child) + _varint(last)
        end -= len(cell)
        page[end : end + len(cell)] = cell
        struct.pack_into(">H", page, 12 + 2 * number, end)
    struct.pack_into(">BHHHBI", page, 0, 5, 0, len(children) - 1, end, 0, children[-1][0])
    return page


def _write(path, topic, messages, more):
    """Write a database of three pages (definitions, topics, messages) and more."""
    definitions = [_definition("topics", 2, _TOPICS), _definition("messages", 3, _MESSAGES)]
    first = _leaf([_cell(number, row) for number, row in enumerate(definitions, start=1)], start=100)
    pages = [first, _leaf([_cell(1, _record(None, *topic, "cdr"))]), messages, *more]
    struct.pack_into(">16sHBBBBBB", first, 0, b"SQLite format 3\0", PAGE, 1, 1, 0, 64, 32, 32)
    struct.pack_into(">IIIIIIIIIII", first, 24, 1, len(pages), 0, 0, 1, 4, 0, 0, 1, 0, 0)
    struct.pack_into(">II", first, 92, 1, 3045000)
    path.write_bytes(b"".join(pages))
    return path
