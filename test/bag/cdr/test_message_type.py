"""Definitions as bags have them: services, actions, IDL, line ends of Windows, short names."""

from __future__ import annotations

from struct import pack

import numpy as np
import pytest

from agv_motion.bag.cdr import message_type
from agv_motion.bag.cdr.message_decoder import MessageDecoder
from agv_motion.bag.cdr.message_type import unfold
from agv_motion.bag.columns.columns import read_topic
from agv_motion.bag.metadata import Topic
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import ConfigurationError

LINE = '=' * 80
CDR = b'\x00\x01\x00\x00'


def read(path, kind, text, data, encoding='ros2msg'):
    """Write a message of a type; return it as an object, and as columns."""
    with BagWriter(path) as writer:
        topic = writer.add(Topic('/t', kind, text, '', (), encoding))
        writer.write(topic, 5, CDR + data)
    with BagReader(path) as bag:
        (message,) = bag.messages()
        return MessageDecoder(message.connection)(message), read_topic(bag, '/t').fields


def test_definitions_with_the_line_ends_of_windows(tmp_path):
    text = f'a/Inner inner\r\nint8 y # why\r\n{LINE}\r\nMSG: a/Inner\r\nint32 MOST=5\r\nint32 x\r\n'
    found, columns = read(tmp_path / 'bag', 'a/msg/Outer', text, pack('<ib', 7, -1))
    assert (found.inner.x, found.y) == (7, -1)
    assert (columns['inner.x'][0], columns['y'][0]) == (7, -1)


def test_a_byte_has_no_sign(tmp_path):
    found, columns = read(
        tmp_path / 'bag', 'a/msg/B', 'byte b\nbyte[] more', b'\xff\0\0\0\1\0\0\0\x80'
    )
    assert found.b == columns['b'][0] == 255
    assert list(found.more) == list(columns['more'][0]) == [128]


def test_a_type_without_its_folder(tmp_path):
    found, columns = read(tmp_path / 'bag', 'std_msgs/String', 'string data', b'\3\0\0\0hi\0')
    assert found.data == columns['data'][0] == 'hi'


EVENT = (
    pack('<BxxxiI', 1, 3, 4) + bytes(range(16)) + b'\0\0\0\0' + pack('<q', 9)
    + pack('<IBxxxI', 1, 1, 0)
)  # fmt: skip
SERVICES = {
    'as the file of the service': 'bool data\r\n---\r\nbool success\r\nstring message\r\n',
    'behind a line': f'{LINE}\nSRV: a/srv/Set\nbool data\n---\nbool success\nstring message\n',
    'as messages': (
        'service_msgs/ServiceEventInfo info\nSet_Request[<=1] request\nSet_Response[<=1] response\n'
        f'{LINE}\nMSG: a/Set_Request\nbool data\n{LINE}\nMSG: a/Set_Response\nbool success\n'
    ),
}


@pytest.mark.parametrize('text', SERVICES.values(), ids=SERVICES)
def test_events_of_services(tmp_path, text):
    found, columns = read(tmp_path / 'bag', 'a/srv/Set_Event', text, EVENT)
    assert (found.info.event_type, found.info.stamp.sec, found.info.sequence_number) == (1, 3, 9)
    assert [request.data for request in found.request] == [True]
    assert not found.response
    assert columns['info.sequence_number'][0] == 9
    assert columns['request.data'].tolist() == [[True]]


def test_feedback_of_actions(tmp_path):
    text = 'int32 order\n---\nint32[] all\n---\nint32[] part\n'
    data = bytes(range(16)) + pack('<Iii', 2, 5, 6)
    found, columns = read(tmp_path / 'bag', 'a/action/Fib_FeedbackMessage', text, data)
    assert list(found.feedback.part) == columns['feedback.part'].tolist()[0] == [5, 6]
    assert found.goal_id.uuid.tolist() == list(range(16))


IDL = f"""{LINE}
IDL: a/msg/State
// generated from rosidl_adapter/resource/msg.idl.em
#include "a/msg/Inner.idl"
module a {{ module msg {{
  @verbatim (language="comment", text="see https://a.b/c" "and (more")
  enum Kind {{ RED, @value(7) GREEN }};
  typedef double Triple[3];
  typedef sequence<a::msg::Inner, 4> Inners;
  module State_Constants {{ const unsigned long SIZE = 2; const string NAME = "x;y"; }};
  struct State {{
    @default (value=5) @unit("m") long x, y;
    Kind kind;
    Triple triple;
    Inners inners;
    short pair[a::msg::State_Constants::SIZE];
    string<10> name; octet raw; unsigned long long big;
  }};
}}; }};
{LINE}
IDL: a/msg/Inner
module a {{ module msg {{ struct Inner {{ uint8 flag; boolean ok; }}; }}; }};
"""


def test_idl_as_rosbag2_writes_it(tmp_path):
    data = pack(
        '<iiIxxxxdddI2B2hxxI3sBxxxxQ',
        1,
        -2,
        7,
        0.5,
        1.5,
        2.5,
        1,
        9,
        1,
        -3,
        4,
        3,
        b'hi\0',
        255,
        2**63,
    )
    for folder, ends in (('unix', '\n'), ('windows', '\r\n')):
        text = IDL.replace('\n', ends)
        found, columns = read(tmp_path / folder, 'a/msg/State', text, data, 'ros2idl')
        assert (found.x, found.y, found.kind, found.name, found.raw) == (1, -2, 7, 'hi', 255)
        assert [(inner.flag, inner.ok) for inner in found.inners] == [(9, True)]
        assert columns['triple'].tolist() == [[0.5, 1.5, 2.5]]
        assert columns['pair'].tolist() == [[-3, 4]]
        assert columns['big'].tolist() == [2**63]


@pytest.mark.parametrize(
    'text',
    [
        'struct A { sequence<sequence<long> > x; };', 'struct A { long double x; };',
        'union A switch (long) { case 1: long x; };', 'struct A { long x',
        'struct A { long x[N]; };', 'module a {', '@x(', 'typedef A A; struct B { A a; };', 'ä',
    ],
)  # fmt: skip
def test_idl_that_is_not_understood_is_refused(text):
    with pytest.raises(ConfigurationError, match='definition of a/msg/A'):
        unfold('a/msg/A', text, 'ros2idl')


def test_wide_strings_are_refused_by_name(tmp_path):
    with pytest.raises(ConfigurationError, match='field w is a wstring'):
        read(tmp_path / 'bag', 'a/msg/W', 'wstring w', bytes(8))


def test_an_empty_message_has_one_byte(tmp_path):
    text = f'b/Nothing a\nint8 x\n{LINE}\nMSG: b/Nothing\n'
    found, columns = read(tmp_path / 'bag', 'a/msg/A', text, b'\0\5')
    assert found.x == columns['x'][0] == 5


@pytest.mark.parametrize('far', [2**63 - 1, 2**63, 2**64 - 1])
def test_log_times_keep_their_sign(tmp_path, far):
    with BagWriter(tmp_path / 'bag') as writer:
        topic = writer.add_topic('/t', 'a/msg/A', 'int8 x', type_hash='')
        for i, stamp in enumerate((far, far - 1, 5)):
            writer.write(topic, stamp, CDR + bytes([i]))
    with BagReader(tmp_path / 'bag') as bag:
        assert [message.stamp for message in bag.messages()] == [5, far - 1, far]
        columns = read_topic(bag, '/t')
        assert columns.stamps.tolist() == [5, far - 1, far]
        assert columns.fields['x'].tolist() == [2, 1, 0]
        assert read_topic(bag, '/t', start=far).stamps.tolist() == [far]
        assert np.all(np.diff(columns.stamps.astype(object)) > 0)


@pytest.mark.parametrize('line', ['', '===', '=== More', '=' * 80 + ' '])
def test_only_a_line_of_equal_signs_begins_another_type(line):
    text = f'B x\n{line}\nMSG: a/B\nuint8 y'
    if line.strip(' ='):
        with pytest.raises(ConfigurationError, match='is no field'):
            unfold('a/msg/A', text, 'ros2msg')
    elif line:
        assert unfold('a/msg/A', text, 'ros2msg').members[0].name == 'x'
    else:
        with pytest.raises(ConfigurationError, match='MSG: a/B'):
            unfold('a/msg/A', text, 'ros2msg')


def test_a_second_name_behind_a_line_is_no_field():
    for text in ('int8 x\n=====\nMSG: a/B\nMSG: a/C\nint8 y', 'MSG: a/C\nint8 y'):
        with pytest.raises(ConfigurationError, match="'MSG: a/C' is no field"):
            unfold('a/msg/A', text, 'ros2msg')


def test_types_are_as_deep_and_large_as_they_may_be_and_no_more(monkeypatch):
    """A, B and C are three deep; they have 2, 2 and 1 fields, and count themselves: 8."""
    text = 'B b\nint8 x\n=====\nMSG: a/B\nC c\nint8 y\n=====\nMSG: a/C\nint8 z'
    for limit, enough, words in (('DEEPEST', 2, 'more than 1 deep'),
                                 ('MOST_FIELDS', 8, 'more than 7 fields')):  # fmt: skip
        monkeypatch.setattr(message_type, limit, enough)
        assert unfold('a/msg/A', text, 'ros2msg').members[1].name == 'x'
        monkeypatch.setattr(message_type, limit, enough - 1)
        with pytest.raises(ConfigurationError, match=words):
            unfold('a/msg/A', text, 'ros2msg')
        monkeypatch.undo()
