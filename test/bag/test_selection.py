"""Topics by name, by expression, all but some."""

from __future__ import annotations

import pytest

from agv_motion.bag.selection import Selection
from agv_motion.errors import ConfigurationError

ALL = ['/cmd_vel', '/oak/cmd_vel', '/state', '/_hidden', '/oak/_ros/x']


@pytest.mark.parametrize(
    ('chosen', 'expected'),
    [
        ({}, []),
        ({'everything': True}, ['/cmd_vel', '/oak/cmd_vel', '/state']),
        ({'everything': True, 'hidden': True}, ALL),
        ({'topics': ('/state', '/_hidden')}, ['/state', '/_hidden']),
        ({'regex': 'cmd'}, ['/cmd_vel', '/oak/cmd_vel']),
        ({'regex': '^/cmd'}, ['/cmd_vel']),
        ({'regex': '^/oak', 'topics': ('/state',)}, ['/oak/cmd_vel', '/state']),
        ({'everything': True, 'exclude_regex': 'vel$'}, ['/state']),
        ({'everything': True, 'exclude_topics': ('/state',)}, ['/cmd_vel', '/oak/cmd_vel']),
        ({'topics': ('/state',), 'exclude_regex': 'st'}, []),
    ],
)
def test_what_is_taken(chosen, expected):
    selection = Selection(**chosen)
    assert [topic for topic in ALL if selection.takes(topic)] == expected


@pytest.mark.parametrize(('topic', 'taken'), [
    ('/add/_service_event', True), ('/turn/_action/status', True), ('/turn/_action/feedback', True),
    ('/_mine/_service_event', False), ('/_mine/turn/_action/status', False),
    ('/add/_other', False), ('/turn/_action/deep/status', False),
])  # fmt: skip
def test_hidden_topics_that_tell_of_services_and_actions_are_shown(topic, taken):
    assert Selection(everything=True).takes(topic) is taken
    assert Selection(everything=True, hidden=True).takes(topic)


@pytest.mark.parametrize('field', ['regex', 'exclude_regex'])
def test_a_broken_expression_is_refused(field):
    with pytest.raises(ConfigurationError, match=field):
        Selection(**{field: '('})
