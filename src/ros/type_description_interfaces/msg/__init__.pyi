# Written by scripts/generate_messages.py from interfaces/type_description_interfaces/msg; do not edit.
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["Field", "FieldType", "IndividualTypeDescription", "KeyValue", "TypeDescription", "TypeSource"]

class Field(Message):
    name: str
    type: FieldType
    default_value: str
    def __init__(self, *, name: str = ..., type: FieldType = ..., default_value: str = ...) -> None: ...

class FieldType(Message):
    FIELD_TYPE_NOT_SET: Final = 0
    FIELD_TYPE_NESTED_TYPE: Final = 1
    FIELD_TYPE_INT8: Final = 2
    FIELD_TYPE_UINT8: Final = 3
    FIELD_TYPE_INT16: Final = 4
    FIELD_TYPE_UINT16: Final = 5
    FIELD_TYPE_INT32: Final = 6
    FIELD_TYPE_UINT32: Final = 7
    FIELD_TYPE_INT64: Final = 8
    FIELD_TYPE_UINT64: Final = 9
    FIELD_TYPE_FLOAT: Final = 10
    FIELD_TYPE_DOUBLE: Final = 11
    FIELD_TYPE_LONG_DOUBLE: Final = 12
    FIELD_TYPE_CHAR: Final = 13
    FIELD_TYPE_WCHAR: Final = 14
    FIELD_TYPE_BOOLEAN: Final = 15
    FIELD_TYPE_BYTE: Final = 16
    FIELD_TYPE_STRING: Final = 17
    FIELD_TYPE_WSTRING: Final = 18
    FIELD_TYPE_FIXED_STRING: Final = 19
    FIELD_TYPE_FIXED_WSTRING: Final = 20
    FIELD_TYPE_BOUNDED_STRING: Final = 21
    FIELD_TYPE_BOUNDED_WSTRING: Final = 22
    FIELD_TYPE_NESTED_TYPE_ARRAY: Final = 49
    FIELD_TYPE_INT8_ARRAY: Final = 50
    FIELD_TYPE_UINT8_ARRAY: Final = 51
    FIELD_TYPE_INT16_ARRAY: Final = 52
    FIELD_TYPE_UINT16_ARRAY: Final = 53
    FIELD_TYPE_INT32_ARRAY: Final = 54
    FIELD_TYPE_UINT32_ARRAY: Final = 55
    FIELD_TYPE_INT64_ARRAY: Final = 56
    FIELD_TYPE_UINT64_ARRAY: Final = 57
    FIELD_TYPE_FLOAT_ARRAY: Final = 58
    FIELD_TYPE_DOUBLE_ARRAY: Final = 59
    FIELD_TYPE_LONG_DOUBLE_ARRAY: Final = 60
    FIELD_TYPE_CHAR_ARRAY: Final = 61
    FIELD_TYPE_WCHAR_ARRAY: Final = 62
    FIELD_TYPE_BOOLEAN_ARRAY: Final = 63
    FIELD_TYPE_BYTE_ARRAY: Final = 64
    FIELD_TYPE_STRING_ARRAY: Final = 65
    FIELD_TYPE_WSTRING_ARRAY: Final = 66
    FIELD_TYPE_FIXED_STRING_ARRAY: Final = 67
    FIELD_TYPE_FIXED_WSTRING_ARRAY: Final = 68
    FIELD_TYPE_BOUNDED_STRING_ARRAY: Final = 69
    FIELD_TYPE_BOUNDED_WSTRING_ARRAY: Final = 70
    FIELD_TYPE_NESTED_TYPE_BOUNDED_SEQUENCE: Final = 97
    FIELD_TYPE_INT8_BOUNDED_SEQUENCE: Final = 98
    FIELD_TYPE_UINT8_BOUNDED_SEQUENCE: Final = 99
    FIELD_TYPE_INT16_BOUNDED_SEQUENCE: Final = 100
    FIELD_TYPE_UINT16_BOUNDED_SEQUENCE: Final = 101
    FIELD_TYPE_INT32_BOUNDED_SEQUENCE: Final = 102
    FIELD_TYPE_UINT32_BOUNDED_SEQUENCE: Final = 103
    FIELD_TYPE_INT64_BOUNDED_SEQUENCE: Final = 104
    FIELD_TYPE_UINT64_BOUNDED_SEQUENCE: Final = 105
    FIELD_TYPE_FLOAT_BOUNDED_SEQUENCE: Final = 106
    FIELD_TYPE_DOUBLE_BOUNDED_SEQUENCE: Final = 107
    FIELD_TYPE_LONG_DOUBLE_BOUNDED_SEQUENCE: Final = 108
    FIELD_TYPE_CHAR_BOUNDED_SEQUENCE: Final = 109
    FIELD_TYPE_WCHAR_BOUNDED_SEQUENCE: Final = 110
    FIELD_TYPE_BOOLEAN_BOUNDED_SEQUENCE: Final = 111
    FIELD_TYPE_BYTE_BOUNDED_SEQUENCE: Final = 112
    FIELD_TYPE_STRING_BOUNDED_SEQUENCE: Final = 113
    FIELD_TYPE_WSTRING_BOUNDED_SEQUENCE: Final = 114
    FIELD_TYPE_FIXED_STRING_BOUNDED_SEQUENCE: Final = 115
    FIELD_TYPE_FIXED_WSTRING_BOUNDED_SEQUENCE: Final = 116
    FIELD_TYPE_BOUNDED_STRING_BOUNDED_SEQUENCE: Final = 117
    FIELD_TYPE_BOUNDED_WSTRING_BOUNDED_SEQUENCE: Final = 118
    FIELD_TYPE_NESTED_TYPE_UNBOUNDED_SEQUENCE: Final = 145
    FIELD_TYPE_INT8_UNBOUNDED_SEQUENCE: Final = 146
    FIELD_TYPE_UINT8_UNBOUNDED_SEQUENCE: Final = 147
    FIELD_TYPE_INT16_UNBOUNDED_SEQUENCE: Final = 148
    FIELD_TYPE_UINT16_UNBOUNDED_SEQUENCE: Final = 149
    FIELD_TYPE_INT32_UNBOUNDED_SEQUENCE: Final = 150
    FIELD_TYPE_UINT32_UNBOUNDED_SEQUENCE: Final = 151
    FIELD_TYPE_INT64_UNBOUNDED_SEQUENCE: Final = 152
    FIELD_TYPE_UINT64_UNBOUNDED_SEQUENCE: Final = 153
    FIELD_TYPE_FLOAT_UNBOUNDED_SEQUENCE: Final = 154
    FIELD_TYPE_DOUBLE_UNBOUNDED_SEQUENCE: Final = 155
    FIELD_TYPE_LONG_DOUBLE_UNBOUNDED_SEQUENCE: Final = 156
    FIELD_TYPE_CHAR_UNBOUNDED_SEQUENCE: Final = 157
    FIELD_TYPE_WCHAR_UNBOUNDED_SEQUENCE: Final = 158
    FIELD_TYPE_BOOLEAN_UNBOUNDED_SEQUENCE: Final = 159
    FIELD_TYPE_BYTE_UNBOUNDED_SEQUENCE: Final = 160
    FIELD_TYPE_STRING_UNBOUNDED_SEQUENCE: Final = 161
    FIELD_TYPE_WSTRING_UNBOUNDED_SEQUENCE: Final = 162
    FIELD_TYPE_FIXED_STRING_UNBOUNDED_SEQUENCE: Final = 163
    FIELD_TYPE_FIXED_WSTRING_UNBOUNDED_SEQUENCE: Final = 164
    FIELD_TYPE_BOUNDED_STRING_UNBOUNDED_SEQUENCE: Final = 165
    FIELD_TYPE_BOUNDED_WSTRING_UNBOUNDED_SEQUENCE: Final = 166
    type_id: int
    capacity: int
    string_capacity: int
    nested_type_name: str
    def __init__(self, *, type_id: int = ..., capacity: int = ..., string_capacity: int = ..., nested_type_name: str = ...) -> None: ...

class IndividualTypeDescription(Message):
    type_name: str
    fields: list[Field]
    def __init__(self, *, type_name: str = ..., fields: list[Field] = ...) -> None: ...

class KeyValue(Message):
    key: str
    value: str
    def __init__(self, *, key: str = ..., value: str = ...) -> None: ...

class TypeDescription(Message):
    type_description: IndividualTypeDescription
    referenced_type_descriptions: list[IndividualTypeDescription]
    def __init__(self, *, type_description: IndividualTypeDescription = ..., referenced_type_descriptions: list[IndividualTypeDescription] = ...) -> None: ...

class TypeSource(Message):
    type_name: str
    encoding: str
    raw_file_contents: str
    def __init__(self, *, type_name: str = ..., encoding: str = ..., raw_file_contents: str = ...) -> None: ...

