"""What a client of `/live` gets: the newest of each slot."""

from __future__ import annotations


def frame(live):
    told = live.receive_json()
    assert told['kind'] == 'frame'
    live.send_json({'ack': told['n']})
    return {(one['robot'], one['topic']): one['value'] for one in told['updates']}


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
        live.receive_json()
        assert frame(live)['oak', 'pose']['x'] == 3.0
