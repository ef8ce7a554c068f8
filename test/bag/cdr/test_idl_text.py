"""Types that a bag defines in IDL."""

from __future__ import annotations

import pytest

from agv_motion.bag.cdr.idl_text import LONGEST_IDL, fields_from_idl
from agv_motion.errors import ConfigurationError

SIZED = 'int8', 'int16', 'int32', 'int64', 'uint8', 'uint16', 'uint32', 'uint64'


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
        *[(f'{name} x;', ('x', name, False, None)) for name in SIZED],
        ('string x;', ('x', 'string', False, None)),
        ('string<20> x;', ('x', 'string', False, None)),
        ('sequence<float> x;', ('x', 'float32', True, None)),
        ('sequence<float, 4> x;', ('x', 'float32', True, None)),
        ('short x[3];', ('x', 'int16', True, 3)),
        ('short x[2][3];', ('x', 'int16', True, 6)),
        ('@default(value=7) unsigned short x;', ('x', 'uint16', False, None)),
    ],
)
def test_a_field_of_every_kind(declared, field):
    assert fields('struct A { ' + declared + ' };') == [field]


def test_what_does_not_describe_data_is_passed_over():
    text = """// a comment with "quotes
    @verbatim (language="comment", text="struct B { long no; };")
    struct A { @unit(value="m") double/*no space*/x; /* long no; */ };"""
    assert fields(text) == [('x', 'float64', False, None)]


def test_typedefs_constants_and_enums_are_resolved():
    text = """const long SIDES = 4;
    typedef double pair[SIDES];
    enum Kind { GOOD, BAD };
    struct A { pair p; Kind kind; };"""
    assert fields(text) == [('p', 'float64', True, 4), ('kind', 'uint32', False, None)]


def test_arrays_of_arrays_are_one_and_what_has_no_size_is_in_none():
    declared = 'typedef double row[2]; typedef row table[3]; typedef sequence<row> rows;'
    assert fields(declared + 'struct A { table t; };') == [('t', 'float64', True, 6)]
    many = 'typedef sequence<double> many;'
    for wrong in (declared + 'struct A { rows r; };', many + 'struct A { many m[2]; };'):
        with pytest.raises(ConfigurationError, match=r'(row|many) is an array in an array'):
            fields(wrong)


def test_a_struct_has_the_fields_of_its_base_before_its_own():
    declared = 'struct B { long a; }; struct C; struct C : B { double y, z; };'
    assert fields(declared, 'a/msg/C') == [
        ('a', 'int32', False, None), ('y', 'float64', False, None), ('z', 'float64', False, None),
    ]  # fmt: skip


@pytest.mark.parametrize(('wrong', 'finding'), [
    ('sequence<short> x[3];', 'stands an array of sequences'),
    ('sequence<sequence<short> > x;', 'stands a sequence of sequences'),
    ('long double x;', 'stands long double, which CDR of ROS does not know'),
])  # fmt: skip
def test_what_cdr_of_ros_has_not_is_refused(wrong, finding):
    with pytest.raises(ConfigurationError, match=finding):
        fields('struct A { ' + wrong + ' };')


def test_types_of_other_modules_are_named_in_full():
    text = (
        'module b { module msg { struct B { long y; }; }; }; '
        + module('struct A { b::msg::B inner; sequence<::b::msg::B> more; };')
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


@pytest.mark.parametrize(
    ('text', 'finding'),
    [
        ('struct A { double };', "after 'A { double' stands '}', expected a name"),
        ('; union', "after ';' stands 'union', expected module or struct or enum or typedef or co"),
        ('struct', "after 'struct' stands '', expected a name"),
        ('struct A { b x', "after '{ b x' stands '', expected ;"),
        ('struct A { b x[SIDES]; };', '(SIDES is no number)'),
    ],
)
def test_the_three_words_before_what_is_not_understood_are_told(text, finding):
    with pytest.raises(ConfigurationError) as caught:
        fields_from_idl('a/msg/A', text)
    assert finding in str(caught.value)


def test_a_text_without_end_is_refused_before_it_is_looked_at():
    with pytest.raises(ConfigurationError, match='characters of IDL, at most'):
        fields_from_idl('a/msg/A', ' ' * (LONGEST_IDL + 1))
