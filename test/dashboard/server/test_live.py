"""What a client of `/live` gets: the newest of each slot, as soon as it has had the last frame."""

from __future__ import annotations

import json

from agv_motion.dashboard.core.board import Board
from agv_motion.dashboard.server.live import Client


def until(live, robot, topic):
    """Return the value of a slot, out of the first frame that has it."""
    while True:
        told = live.receive_json()
        live.send_json({'ack': told.get('n', 0)})
        for one in told.get('updates', ()):
            if (one['robot'], one['topic']) == (robot, topic):
                return one['value']


def test_the_first_message_tells_role_token_and_robots(browser):
    hello = browser.hello()
    assert hello['kind'] == 'hello'
    assert hello['role'] == 'expert'
    assert hello['robots'] == ['ash', 'oak']
    assert len(hello['csrf']) >= 32


def test_a_frame_has_what_is_newest(browser, robots, messages):
    robots.say('oak', 'pose', messages.pose(1.0, 2.0))
    robots.say('oak', 'pose', messages.pose(3.0, 4.0))
    with browser.look() as live:
        assert until(live, 'oak', 'pose')['x'] == 3.0
        robots.say('oak', 'pose', messages.pose(5.0, 4.0))
        robots.say('oak', 'pose', messages.pose(6.0, 4.0))
        assert until(live, 'oak', 'pose')['x'] == 6.0


def test_a_robot_that_says_no_numbers_is_shown_as_such(browser, robots, messages):
    robots.say('oak', 'pose', messages.pose(float('nan'), float('inf')))
    robots.say('oak', 'odom', messages.odom(float('nan')))
    robots.say('oak', 'granier/sap_flow', object())
    with browser.look() as live:
        pose = until(live, 'oak', 'pose')
    assert (pose['x'], pose['y']) == (None, None)


def test_what_a_client_says_is_taken_or_let_be():
    client = Client(public=False)
    client.number = 3
    for text in ('', '{', '[]', '7', '"x"', '{"ack": "x"}', '{"ack": 9}', '{"want": {}}',
                 '[' * 9999, '{"want": [1, null, {}]}', '{"ack": null, "want": null}'):  # fmt: skip
        client.hear(text)
    assert (client.acknowledged, client.wanted) == (0, set())
    client.hear('{"ack": 3, "want": ["oak/memory/sap_flow", "/zone"]}')
    assert (client.acknowledged, client.wanted) == (3, {('oak', 'memory/sap_flow'), ('', 'zone')})


def test_who_waits_gets_the_newest_and_no_more():
    board, client = Board(), Client(public=False)
    for value in range(1000):
        board.put('oak', 'state', 1.0, value)
    told = json.loads(client.frame(board, 2.0))
    assert [one['value'] for one in told['updates']] == [999]
    assert client.frame(board, 3.0) == ''


def test_outcomes_that_nobody_takes_do_not_pile_up():
    client = Client(public=False)
    for number in range(10_000):
        client.tell(str(number))
    assert len(client.outcomes) <= 101
    assert client.outcomes[-1] == '9999'
