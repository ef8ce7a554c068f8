"""Columns hold what rosbags decodes, for definitions and values that hypothesis makes up."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from agv_motion.bag.columns.column import Ragged
from agv_motion.bag.columns.columns import read_topic
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter

NUMBERS = {
    'bool': 'bool', 'byte': 'int8', 'char': 'uint8', 'int8': 'int8', 'uint8': 'uint8',
    'int16': 'int16', 'uint16': 'uint16', 'int32': 'int32', 'uint32': 'uint32', 'int64': 'int64',
    'uint64': 'uint64', 'float32': 'float32', 'float64': 'float64',
}  # fmt: skip
ROOT = 'made/msg/Up'
SEPARATOR = '=' * 80


@st.composite
def definitions(draw):
    """Return the text of a type that uses up to three others, each only those after it."""
    names = ['Up', 'Inner', 'Deep', 'Deepest'][: draw(st.integers(1, 4))]
    texts = []
    for i, name in enumerate(names):
        lines = []
        for j in range(draw(st.integers(1, 5))):
            kind = draw(st.sampled_from([*NUMBERS, 'string', *names[i + 1 :]]))
            array = draw(st.sampled_from(['', '', '', '[]', '[3]', '[<=9]']))
            lines.append(f'{kind}{array} field_{j}  # of a {name}')
        texts.append('\n'.join([*lines, 'int32 CONSTANT=7', '']))
    head, *others = texts
    rest = zip(names[1:], others, strict=True)
    return head + ''.join(f'{SEPARATOR}\nMSG: made/{name}\n{text}' for name, text in rest)


def store_of(text):
    """Return a type store of rosbags that knows the definition."""
    store = get_typestore(Stores.EMPTY)
    store.register(get_types_from_msg(text, ROOT))
    return store


def _number(kind):
    if kind.startswith('float'):
        return st.floats(width=int(kind[5:]), allow_nan=False)
    if kind == 'bool':
        return st.booleans()
    limits = np.iinfo(NUMBERS[kind])
    return st.integers(int(limits.min), int(limits.max))


@st.composite
def values(draw, store, name=ROOT, longest=3):
    """Return a message of a type."""
    made = {}
    for field, (kind, content) in store.get_msgdef(name).fields:
        if kind in (Nodetype.BASE, Nodetype.NAME):
            made[field] = draw(_value(store, kind, content))
            continue
        (inner, of), size = content
        fixed = kind == Nodetype.ARRAY
        count = size if fixed else draw(st.integers(0, longest))
        items = [draw(_value(store, inner, of)) for _ in range(count)]
        number = inner == Nodetype.BASE and of[0] in NUMBERS
        made[field] = np.array(items, NUMBERS[of[0]]) if number else items
    return store.types[name](**made)


def _value(store, kind, content):
    if kind == Nodetype.NAME:
        return values(store, content)
    if content[0] == 'string':
        return st.text(max_size=5)
    return _number(content[0])


def field_of(message, path):
    """Return the values of a field of a message, in nested lists where there are arrays."""
    head, _, rest = path.partition('.')
    value = getattr(message, head)
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if rest:
        return (
            [field_of(v, rest) for v in value] if isinstance(value, list) else field_of(value, rest)
        )
    return value


def dtype_of(column):
    """Return the dtype of the innermost values of a column; None of texts."""
    return dtype_of(column.values) if isinstance(column, Ragged) else getattr(column, 'dtype', None)


def unsigned(value):
    """Return nested lists of bytes without sign."""
    return [unsigned(v) for v in value] if isinstance(value, list) else value % 256


def write(path, messages, text, chunk_size=3000):
    with BagWriter(path, chunk_size=chunk_size, chunk_duration=1e9) as writer:
        topic = writer.add_topic('/topic', ROOT, text, type_hash='')
        for i, data in enumerate(messages):
            writer.write(topic, i, bytes(data))
    return path


def columns(path, fields=None):
    with BagReader(path) as bag:
        return read_topic(bag, '/topic', fields)


@pytest.fixture(scope='module')
def folder(tmp_path_factory):
    """Return a folder that counts on, for tests that are run with many examples."""
    base, count = tmp_path_factory.mktemp('bags'), iter(range(1_000_000))
    return lambda: base / str(next(count))


@given(data=st.data())
@settings(max_examples=20, deadline=None)
def test_every_field_of_every_message_is_that_of_rosbags(folder, data):
    text = data.draw(definitions())
    store = store_of(text)
    different = data.draw(st.lists(values(store), min_size=1, max_size=6))
    picked = data.draw(
        st.lists(st.tuples(st.sampled_from(different), st.booleans()), min_size=1, max_size=60)
    )
    raw = [store.serialize_cdr(m, ROOT, little_endian=little) for m, little in picked]
    chunk = data.draw(st.sampled_from([1, 300, 100_000]))
    found = columns(write(folder(), raw, text, chunk))
    decoded = [store.deserialize_cdr(r, ROOT) for r in raw]
    assert found.stamps.tolist() == list(range(len(raw)))
    for path, column in found.fields.items():
        assert len(column) == len(raw)
        expected = [field_of(m, path) for m in decoded]
        if dtype_of(column) == np.uint8:
            expected = unsigned(expected)  # rosbags gives a byte a sign, ROS does not
        assert column.tolist() == expected, path


@given(data=st.data())
@settings(max_examples=10, deadline=None)
def test_a_selected_field_is_the_same_as_among_all(folder, data):
    text = data.draw(definitions())
    store = store_of(text)
    messages = data.draw(st.lists(values(store), min_size=1, max_size=5)) * 5
    path = write(folder(), [store.serialize_cdr(m, ROOT) for m in messages], text)
    every = columns(path)
    wanted = data.draw(st.sampled_from(sorted(every.fields)))
    found = columns(path, [wanted])
    assert list(found.fields) == [wanted]
    assert found.fields[wanted].tolist() == every.fields[wanted].tolist()
    head = wanted.split('.')[0]
    inside = [p for p in every.fields if p.split('.')[0] == head]
    assert sorted(columns(path, [head]).fields) == sorted(inside)
