"""Acts: who may, with which token, once for each key, and how each ends."""

from __future__ import annotations

import pytest

from agv_motion.dashboard.server.fleet import NoAnswerError, RefusedError
from agv_motion.planar import REST


def outcomes(live, count):
    """Return the next outcomes, with frames between them acknowledged."""
    found = []
    while len(found) < count:
        told = live.receive_json()
        if told['kind'] == 'outcome':
            found.append(told)
        elif told['kind'] == 'frame':
            live.send_json({'ack': told['n']})
    return found


@pytest.mark.parametrize(
    ('path', 'action'),
    [('stop', 'stop'), ('release', 'release'), ('pause', 'pause'), ('resume', 'resume'),
     ('home', 'home'), ('next_goal', 'next_goal'), ('lock', 'lock'), ('unlock', 'unlock')],
)  # fmt: skip
def test_an_act_reaches_the_robot_that_is_named(browser, robots, path, action):
    answer = browser.act(f'/robots/oak/{path}')
    assert answer.status_code == 202
    assert answer.json()['id']
    assert [(robot, what) for robot, what, _ in robots.asked] == [('oak', action)]


def test_stop_all_reaches_every_robot(browser, robots):
    assert browser.act('/stop').status_code == 202
    assert {robot for robot, what, _ in robots.asked if what == 'stop'} == {'oak', 'ash'}


def test_a_goal_is_sent_with_its_place(browser, robots):
    assert browser.act('/robots/oak/goal', {'x': 1.5, 'y': -2}).status_code == 202
    assert robots.asked[0][2] == {'x': 1.5, 'y': -2.0, 'heading': 0.0, 'by': 'local'}


@pytest.mark.parametrize(
    ('told', 'words'),
    [
        ({'x': 1.0}, 'y = '),
        ({'x': '1', 'y': 2.0}, 'expected a number'),
        ({'x': True, 'y': 2.0}, 'expected a number'),
        ({'x': 1e9, 'y': 2.0}, 'must lie in'),
        ({'x': 1.0, 'y': 10**400}, 'y = 1000'),
        ({'x': 1.0, 'y': 2.0, 'z': 3.0}, "unknown key 'z'"),
        ({'x': 1.0, 'y': 2.0, 'heading': 100}, 'heading = 100'),
    ],
)
def test_a_goal_that_is_none_is_refused(browser, robots, told, words):
    answer = browser.act('/robots/oak/goal', told)
    assert answer.status_code in {400, 422}
    assert words in answer.json()['error']
    assert robots.asked == []


@pytest.mark.parametrize(
    'text',
    ['{"x": NaN, "y": 1}', '{"x": Infinity, "y": 1}', '[1, 2]', '{', '[' * 100_00, '7',
     '{"x": 1, "y": "\\ud800"}'],
)  # fmt: skip
def test_what_is_no_json_is_refused(browser, robots, text):
    headers = {'X-CSRF-Token': browser.hello()['csrf'], 'Idempotency-Key': 'k' * 10}
    answer = browser.post('/robots/oak/goal', content=text, headers=headers)
    assert answer.status_code == 400
    assert robots.asked == []


def test_a_body_of_another_kind_is_refused(browser, robots):
    headers = {
        'X-CSRF-Token': browser.hello()['csrf'], 'Idempotency-Key': 'k' * 10,
        'Content-Type': 'text/plain',
    }  # fmt: skip
    answer = browser.post('/robots/oak/goal', content='{"x":1,"y":1}', headers=headers)
    assert answer.status_code == 415
    assert robots.asked == []


@pytest.mark.parametrize('token', ['', 'x', '0' * 64, 'é'])
def test_an_act_without_the_token_is_refused(browser, robots, token):
    headers = [(b'x-csrf-token', token.encode()), (b'idempotency-key', b'k' * 10)]
    answer = browser.post('/stop', json={}, headers=headers)
    assert answer.status_code == 403
    assert robots.asked == []


def test_the_same_request_again_is_answered_again_and_not_done_again(browser, robots):
    first = browser.act('/robots/oak/next_goal', **{'Idempotency-Key': 'the-same-key'})
    again = browser.act('/robots/oak/next_goal', **{'Idempotency-Key': 'the-same-key'})
    assert again.status_code == 202
    assert again.json() == first.json()
    assert again.headers['Idempotency-Replayed'] == 'true'
    assert len(robots.asked) == 1


def test_a_key_of_another_act_is_refused(browser, robots):
    browser.act('/robots/oak/next_goal', **{'Idempotency-Key': 'the-same-key'})
    answer = browser.act('/robots/ash/next_goal', **{'Idempotency-Key': 'the-same-key'})
    assert answer.status_code == 409
    assert len(robots.asked) == 1


def test_an_act_without_a_key_is_refused_but_stop_never(browser, robots):
    token = {'X-CSRF-Token': browser.hello()['csrf']}
    assert browser.post('/robots/oak/home', json={}, headers=token).status_code == 400
    assert robots.asked == []
    assert browser.post('/robots/oak/stop', json={}, headers=token).status_code == 202


@pytest.mark.parametrize('name', ['yew', '%2e%2e', '<script>', 'oak%00', '\u00e9', 'OAK'])
def test_a_robot_that_is_not_there_is_refused(browser, robots, name):
    assert browser.act(f'/robots/{name}/stop').status_code in {404, 405}
    assert robots.asked == []


def test_a_refusal_is_told_in_the_words_of_the_robot(browser, robots):
    robots.answer = RefusedError('the zone ends here')
    with browser.look() as live:
        live.receive_json()
        number = browser.act('/robots/oak/home').json()['id']
        sent, refused = outcomes(live, 2)
    assert (sent['state'], sent['id'], sent['robot']) == ('sent', number, 'oak')
    assert (refused['state'], refused['text']) == ('refused', 'the zone ends here')


def test_a_robot_that_does_not_answer_is_told(browser, robots):
    robots.answer = NoAnswerError('no answer of /oak/arbiter/stop in 1 s')
    with browser.look() as live:
        live.receive_json()
        browser.act('/robots/oak/stop')
        assert outcomes(live, 2)[1]['state'] == 'no_answer'


def test_stop_is_done_only_when_the_wheels_are_measured_to_stand(browser, robots, messages):
    with browser.look() as live:
        live.receive_json()
        robots.say('oak', 'turrets/state', messages.turrets(rates=(1.0, 1.0, 1.0)))
        robots.say('oak', 'driver', messages.status('driver', stop='true', driver='stop'))
        browser.act('/robots/oak/stop')
        assert outcomes(live, 1)[0]['state'] == 'sent'
        robots.time += 1.0
        robots.say('oak', 'turrets/state', messages.turrets(rates=(1.0, 0.0, 0.0)))
        assert not robots.board.robots['oak'].stands()
        robots.time += 1.0
        robots.say('oak', 'turrets/state', messages.turrets(rates=(0.0, 0.0, 0.0)))
        assert outcomes(live, 1)[0]['state'] == 'done'


def test_a_hand_drives_and_what_is_no_twist_ends_it(browser, robots):
    csrf = browser.hello()['csrf']
    with browser.socket('/robots/oak/drive') as hand:
        hand.send_json({'csrf': csrf})
        hand.send_json({'n': 1, 't': 1000.0, 'vx': 0.1, 'vy': 0.0, 'wz': 0.0})
        hand.send_json({'n': 2, 't': 1050.0, 'icr': [0.0, 2.0], 'speed': 0.5})
        hand.send_json({'n': 2, 't': 1060.0, 'vx': 9.0, 'vy': 0.0, 'wz': 0.0})
        hand.send_json({'n': 3, 't': 1100.0, 'vx': 0.0, 'vy': 0.0, 'wz': 0.0})
        hand.send_text('{"n": 4, "t": 1150, "vx": NaN, "vy": 0, "wz": 0}')
        assert hand.receive()['type'] == 'websocket.close'
    twists = [twist for _, twist, _ in robots.driven]
    assert [tuple(twist) for twist in twists] == [(0.1, 0.0, 0.0), (0.5, 0.0, 0.25), REST]
    assert all(robot == 'oak' for robot, _, _ in robots.driven)


def test_a_hand_that_sends_a_number_beyond_every_float_is_told_so(browser, robots):
    csrf = browser.hello()['csrf']
    with browser.socket('/robots/oak/drive') as hand:
        hand.send_json({'csrf': csrf})
        hand.send_json({'n': 1, 't': 0.0, 'vx': 10**400, 'vy': 0.0, 'wz': 0.0})
        told = hand.receive()
    assert (told['type'], told['code']) == ('websocket.close', 1008)
    assert told['reason'].startswith('vx = 1000')
    assert robots.driven == []


def test_a_hand_without_the_token_moves_nothing(browser, robots):
    with browser.socket('/robots/oak/drive') as hand:
        hand.send_json({'csrf': 'x' * 64})
        hand.send_json({'n': 1, 't': 0.0, 'vx': 1.0, 'vy': 0.0, 'wz': 0.0})
        assert hand.receive()['type'] == 'websocket.close'
    assert robots.driven == []


def test_a_hand_whose_commands_stay_too_old_is_told_so_once(browser, robots, monkeypatch):
    monkeypatch.setattr('agv_motion.dashboard.server.drive.TOLERATED', 0.0)
    csrf = browser.hello()['csrf']
    with browser.socket('/robots/oak/drive') as hand:
        hand.send_json({'csrf': csrf})
        hand.send_json({'n': 1, 't': 9000.0, 'vx': 0.1, 'vy': 0.0, 'wz': 0.0})
        hand.send_json({'n': 2, 't': 4000.0, 'vx': 0.1, 'vy': 0.0, 'wz': 0.0})
        assert 'commands come 5.0 s late and are refused' in hand.receive_json()['text']
        hand.send_json({'n': 3, 't': 4000.0, 'vx': 0.1, 'vy': 0.0, 'wz': 0.0})
        hand.send_json({'n': 4, 't': 9000.0, 'vx': 0.2, 'vy': 0.0, 'wz': 0.0})
        assert hand.receive_json() == {'text': ''}
    assert [twist.vx for _, twist, _ in robots.driven] == [0.1, 0.2]


def test_clocks_that_part_slowly_make_no_command_old_but_what_is_held_up_is():
    from agv_motion.dashboard.server.drive import BrowserClock

    clock = BrowserClock()
    for second in range(0, 6 * 3600, 10):  # half of it: 1.08 s in six hours
        assert clock.age(second * (1 - 5e-5), 500.0 + second) == pytest.approx(0.0, abs=1e-9)
    late = clock.age(6 * 3600 * (1 - 5e-5) - 0.4, 500.0 + 6 * 3600)
    assert late == pytest.approx(0.4 - 10 * 5e-5, abs=1e-9)


def test_a_second_hand_is_refused_while_the_first_one_moves(browser, robots):
    csrf = browser.hello()['csrf']
    with browser.socket('/robots/oak/drive') as one, browser.socket('/robots/oak/drive') as two:
        one.send_json({'csrf': csrf})
        two.send_json({'csrf': csrf})
        one.send_json({'n': 1, 't': 0.0, 'vx': 0.1, 'vy': 0.0, 'wz': 0.0})
        two.send_json({'n': 1, 't': 0.0, 'vx': -0.1, 'vy': 0.0, 'wz': 0.0})
        assert two.receive()['type'] == 'websocket.close'
    assert [tuple(twist) for _, twist, _ in robots.driven] == [(0.1, 0.0, 0.0)]
