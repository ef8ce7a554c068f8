"""Types that a bag defines in IDL."""

from __future__ import annotations

import pytest

from agv_motion.bag.cdr.idl_text import LONGEST_IDL, fields_from_idl
from agv_motion.errors import ConfigurationError


def module(inside):
    return 'module a { module msg { ' + inside + ' }; };'


def fields(inside, name='a/msg/A'):
    return fields_from_idl('a/msg/A', module(inside))[name]


@pytest.mark.parametrize(
    ('declared', 'field'),
    [
        ('double x;', ('x', 'float64', False, None)),
        ('unsigned long long x;', ('x', 'uint64', False, None)),
        ('long x;', ('x', 'int32', False, None)),
        ('octet x;', ('x', 'byte', False, None)),
        ('uint8 x;', ('x', 'uint8', False, None)),
        ('string x;', ('x', 'string', False, None)),
        ('string<20> x;', ('x', 'string', False, None)),
        ('sequence<float> x;', ('x', 'float32', True, None)),
        ('sequence<float, 4> x;', ('x', 'float32', True, None)),
        ('short x[3];', ('x', 'int16', True, 3)),
    ],
)
def test_a_field_of_every_kind(declared, field):
    assert fields('struct A { ' + declared + ' };') == [field]


def test_what_does_not_describe_data_is_passed_over():
    text = """// a comment with "quotes
    @verbatim (language="comment", text="struct B { long no; };")
    struct A { @unit(value="m") double x; /* long no; */ };"""
    assert fields(text) == [('x', 'float64', False, None)]


def test_typedefs_constants_and_enums_are_resolved():
    text = """const long SIDES = 4;
    typedef double pair[SIDES];
    enum Kind { GOOD, BAD };
    struct A { pair p; Kind kind; };"""
    assert fields(text) == [('p', 'float64', True, 4), ('kind', 'uint32', False, None)]


def test_types_of_other_modules_are_named_in_full():
    text = (
        'module b { module msg { struct B { long y; }; }; }; '
        + module('struct A { b::msg::B inner; sequence<b::msg::B> more; };')
    )  # fmt: skip
    assert fields_from_idl('a/msg/A', text)['a/msg/A'] == [
        ('inner', 'b/msg/B', False, None), ('more', 'b/msg/B', True, None),
    ]  # fmt: skip


@pytest.mark.parametrize(
    'wrong', ['struct A { double };', 'struct A { double x', 'struct { long x; };', 'union A {};']
)
def test_what_is_not_understood_is_told_with_its_place(wrong):
    with pytest.raises(ConfigurationError, match='definition of a/msg/A: its IDL cannot be'):
        fields(wrong)


def test_a_text_without_end_is_refused_before_it_is_looked_at():
    with pytest.raises(ConfigurationError, match='characters of IDL, at most'):
        fields_from_idl('a/msg/A', ' ' * (LONGEST_IDL + 1))
