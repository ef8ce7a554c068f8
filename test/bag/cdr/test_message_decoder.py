"""Messages as objects by the definition in a bag."""

from __future__ import annotations

from struct import pack

import pytest
from rosbags.interfaces import Nodetype

from agv_motion.bag.cdr.message_decoder import MessageDecoder
from agv_motion.bag.connection import Connection, Message
from agv_motion.errors import ConfigurationError, SourceError

DEFINITION = 'int32 x\nInner inner\nbyte[2] two\n=====\nMSG: mine/Inner\nfloat64[] values\n'
TOPIC = Connection('/a', 'mine/msg/Outer', DEFINITION, 'ros2msg', 'cdr', '', ())
DATA = b'\0\1\0\0' + pack('<iI', -7, 1) + pack('<d', 0.5) + b'\x05\x06'


def message(data):
    return Message(TOPIC, 77, data, 0, 0)


def test_a_type_that_is_installed_nowhere_is_understood():
    decoder = MessageDecoder(TOPIC)
    number = (Nodetype.BASE, ('float64', 0))
    inner = [('values', (Nodetype.SEQUENCE, (number, 0)))]
    assert decoder.store.fielddefs['mine/msg/Inner'] == ([], inner)
    found = decoder(message(DATA))
    assert (found.x, list(found.inner.values), list(found.two)) == (-7, [0.5], [5, 6])


def test_a_message_without_fields_is_understood_too():
    empty = TOPIC._replace(type='mine/msg/Empty', definition='# nothing\n')
    MessageDecoder(empty)(message(b'\0\1\0\0\0'))


@pytest.mark.parametrize(
    ('change', 'words'),
    [
        ({'encoding': 'json'}, "encoded in 'json'; only CDR is understood"),
        ({'definition': '', 'definition_encoding': ''}, 'the bag has no definition of'),
        ({'definition': 'nonsense'}, 'is no field'),
        ({'definition': 'Lost x'}, 'mine/Lost is not defined'),
    ],
)
def test_what_cannot_be_decoded_is_told_with_bag_and_topic(change, words):
    with pytest.raises(ConfigurationError, match=rf'bag walk, topic /a: .*{words}'):
        MessageDecoder(TOPIC._replace(**change), 'walk')


@pytest.mark.parametrize('kind', [
    'a/msg/A({} or object)', "a/msg/A': {}, 'b", 'a/msg/A:\n {}\nclass B', 'a/msg/A;{};',
])  # fmt: skip
def test_no_name_of_a_type_is_run_as_code(tmp_path, monkeypatch, kind):
    monkeypatch.chdir(tmp_path)
    evil = TOPIC._replace(type=kind.format('open("run", "w").close()'), definition='int32 x')
    with pytest.raises(ConfigurationError, match='expected a name such as'):
        MessageDecoder(evil)
    assert list(tmp_path.iterdir()) == []


def test_a_message_of_another_type_is_told_with_its_time():
    with pytest.raises(SourceError, match='the message at 77 ns is no mine/msg/Outer'):
        MessageDecoder(TOPIC)(message(DATA[:-6]))
