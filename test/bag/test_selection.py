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


@pytest.mark.parametrize('field', ['regex', 'exclude_regex'])
def test_a_broken_expression_is_refused(field):
    with pytest.raises(ConfigurationError, match=field):
        Selection(**{field: '('})
