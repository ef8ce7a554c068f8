"""Messages of one topic into columns: alike ones together, others one by one, all the same."""

from __future__ import annotations

from pathlib import Path
from struct import pack

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.bag.columns import topic_decoder
from agv_motion.bag.columns.batch import Batch
from agv_motion.bag.columns.topic_decoder import TopicDecoder
from agv_motion.bag.connection import Connection
from agv_motion.bag.damage import DamagedBagError
from agv_motion.errors import ConfigurationError

TOPIC = Connection(
    '/a', 'a/msg/A', 'string name\nfloat64 x\nuint16[] v\nbool on', 'ros2msg', 'cdr', '', ()
)


def message(name, x, values, *, order='<'):
    raw = name if isinstance(name, bytes) else name.encode()
    data = pack(f'{order}I', len(raw) + 1) + raw + b'\0'
    data += bytes(-len(data) % 8) + pack(f'{order}dI', x, len(values))
    return data + pack(f'{order}{len(values)}H?', *values, x > 0)


def batch(messages, forms=None):
    data = b''.join(messages) + bytes(16)
    sizes = np.array([len(m) for m in messages])
    starts = np.cumsum(sizes) - sizes
    forms = np.array(forms or [1] * len(messages))
    stamps = np.arange(len(messages))
    return Batch(1, data, starts, sizes, forms, stamps, Path('x.mcap'), [(0, 7000)])


def rows_of(decoder):
    """Return the columns as lists, by path."""
    found = {}
    for leaf in decoder.leaves:
        values, counts = decoder.builders[leaf.number].finish()
        if isinstance(counts, int):
            rows = values.tolist()
        else:
            ends = np.cumsum(counts)
            rows = [values[e - n : e].tolist() for e, n in zip(ends, counts, strict=True)]
        if leaf.type == 'string':
            rows = [[decoder.texts[leaf.number].values[code] for code in row] for row in rows]
        found[leaf.path, leaf.type == 'length'] = rows
    return found


@settings(max_examples=40)
@given(
    st.lists(
        st.tuples(
            st.sampled_from(['odom', 'base', 'a', '']),
            st.floats(-9, 9),
            st.lists(st.integers(0, 9), max_size=2),
            st.booleans(),
        ),
        min_size=1,
        max_size=16,
    ),
    st.integers(1, 3),
)
def test_what_was_written_is_read_whatever_is_alike(told, batches):
    decoder = TopicDecoder(TOPIC, None, len(told), 1 << 16)
    written = [message(n, x, v, order='<' if little else '>') for n, x, v, little in told]
    size = -(-len(told) // batches)
    for k in range(0, len(told), size):
        forms = [int(little) for *_, little in told[k : k + size]]
        decoder.put(batch(written[k : k + size], forms))
    found = rows_of(decoder)
    assert found['name', False] == [[name] for name, *_ in told]
    assert found['x', False] == [[x] for _, x, *_ in told]
    assert found['v', False] == [values for *_, values, _ in told]
    assert found['v', True] == [[len(values)] for *_, values, _ in told]
    assert found['on', False] == [[x > 0] for _, x, *_ in told]


def test_parts_that_fit_into_the_cache_give_the_same(monkeypatch):
    messages = [message('odom', k, [k]) for k in range(30)]
    whole = TopicDecoder(TOPIC, None, 30, 1 << 16)
    whole.put(batch(messages))
    monkeypatch.setattr(topic_decoder, 'CACHED', 100)
    parts = TopicDecoder(TOPIC, None, 30, 1 << 16)
    parts.put(batch(messages))
    assert rows_of(parts) == rows_of(whole)
    assert parts.stamps.finish().tolist() == list(range(30))


def learnt(monkeypatch, *batches):
    """Return how many layouts are learnt from each of some batches of names."""
    counts, decoder = [], TopicDecoder(TOPIC, None, 99, 1 << 16)
    whole = topic_decoder.FixedLayout
    monkeypatch.setattr(
        topic_decoder, 'FixedLayout', lambda *given: counts.append(1) or whole(*given)
    )
    for names in batches:
        before = len(counts)
        decoder.put(batch([message(name, 1.0, [1]) for name in names]))
        yield len(counts) - before


def test_a_layout_that_many_messages_share_is_learnt_once(monkeypatch):
    """The names are of one size in CDR, with their padding."""
    names = ['', 'abc'] * topic_decoder.FEW
    assert list(learnt(monkeypatch, names, names)) == [2, 0]


def test_what_few_share_is_not_worth_a_layout(monkeypatch):
    few = topic_decoder.FEW - 1
    names = ['', 'a', 'abc'] * few
    assert list(learnt(monkeypatch, names, names)) == [1, 1]


def test_layouts_that_are_kept_have_an_end(monkeypatch):
    monkeypatch.setattr(topic_decoder, '_MOST_LAYOUTS', 1)
    names = ['', 'abc'] * topic_decoder.FEW
    assert list(learnt(monkeypatch, names, names)) == [2, 1]


def test_only_wanted_fields_are_read_with_the_lengths_around_them():
    decoder = TopicDecoder(TOPIC, ['v'], 1, 100)
    assert [(leaf.path, leaf.type) for leaf in decoder.leaves] == [('v', 'length'), ('v', 'uint16')]
    with pytest.raises(ConfigurationError, match=r"no field 'nam'; did you mean 'name'"):
        TopicDecoder(TOPIC, ['nam'], 1, 100)
    with pytest.raises(ConfigurationError, match='it has name, on, v, x'):
        TopicDecoder(TOPIC, ['quaternion'], 1, 100)
    with pytest.raises(ConfigurationError, match="encoded in 'json': only CDR"):
        TopicDecoder(TOPIC._replace(encoding='json'), None, 1, 100)


@pytest.mark.parametrize('count', [1, 10])
def test_a_message_that_is_none_is_told_with_its_place(count):
    good = message('odom', 1.0, [1])
    with pytest.raises(DamagedBagError, match=r'byte 7000.*no a/msg/A \(encapsulation 0x0007'):
        TopicDecoder(TOPIC, None, 1, 100).put(batch([good] * count, [7] * count))
    with pytest.raises(DamagedBagError, match='bytes end before'):
        TopicDecoder(TOPIC, None, 1, 100).put(batch([good[:-3]] * count))
    bad = message(b'\xff\xfe', 1.0, [1])
    with pytest.raises(DamagedBagError, match='field name is not UTF-8'):
        TopicDecoder(TOPIC, None, 1, 100).put(batch([bad] * count))


def test_a_batch_is_decoded_in_parts_that_fit_into_the_cache(monkeypatch):
    """Of 10 bytes each, or of one message: after 8 bytes the next 4 and 20 are too many."""
    monkeypatch.setattr(topic_decoder, 'CACHED', 10)
    connection = Connection('/a', 'a/msg/A', 'uint8[] x', 'ros2msg', 'cdr', '', ())
    decoder, parts = TopicDecoder(connection, None, 5, 99), []
    monkeypatch.setattr(decoder, '_put', lambda part: parts.append(part.sizes.tolist()))
    sizes = np.array([4, 4, 4, 20, 1])
    none = np.zeros(5, np.int64)
    decoder.put(Batch(0, b'', none, sizes, none, none, Path('x'), [(0, 0)]))
    assert parts == [[4, 4], [4], [20], [1]]
