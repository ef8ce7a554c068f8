"""The newest message of one topic: decoded and converted once, and only when somebody looks."""

from __future__ import annotations

from std_msgs.msg import String

from agv_motion.dashboard.core.entry import Entry


def test_message_is_decoded_and_converted_once_and_only_when_somebody_looks():
    calls = []

    def decode(data):
        calls.append('decoded')
        return String(data=data.decode())

    def convert(message):
        calls.append('converted')
        return {'text': message.data}

    entry = Entry(1.0, b'walking', decode, ('data',))
    assert calls == []
    assert entry.converted(convert) == {'text': 'walking'}
    assert entry.converted(convert) is entry.converted(convert)
    assert calls == ['decoded', 'converted']


def test_each_conversion_gets_what_it_makes_itself():
    entry = Entry(1.0, String(data='walking'))
    assert entry.converted(lambda m: m.data) == 'walking'
    assert entry.converted(lambda m: len(m.data)) == 7


def test_what_lacks_a_field_is_no_message():
    assert Entry(1.0, object(), None, ('data',)).message is None
