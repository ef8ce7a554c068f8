"""Parameters: set live by experts, saved with author and comment, compared, reverted."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

CHANGE = {'node': 'motion_generator', 'name': 'rest.arrival', 'value': 2.0}
PLACE = '/robots/oak/parameters'


def test_a_parameter_is_set_by_its_node(browser, robots):
    assert browser.act(PLACE, CHANGE).status_code == 202
    robot, action, arguments = robots.asked[0]
    assert (robot, action) == ('oak', 'set_parameters')
    assert arguments == {'node': 'motion_generator', 'values': {'rest.arrival': 2.0}}


@pytest.mark.parametrize('told', [{}, CHANGE | {'value': 'x' * 30_000}, CHANGE | {'node': ''}])
def test_what_is_no_change_is_refused(browser, robots, told):
    assert browser.act(PLACE, told).status_code in {413, 422}
    assert robots.asked == []


def test_an_operator_does_not_change_parameters(visit, robots):
    assert visit('operators').act(PLACE, CHANGE).status_code == 403
    assert visit('experts').act(PLACE, CHANGE).status_code == 202
    assert len(robots.asked) == 1


def test_what_was_saved_is_compared_and_reverted(browser, robots):
    assert browser.act(f'{PLACE}/save', {'comment': 'as it was'}).status_code == 202
    saved = browser.get(f'{PLACE}/saved').json()
    assert [(one['by'], one['comment']) for one in saved] == [('local', 'as it was')]
    number = saved[0]['id']
    assert browser.get(f'{PLACE}/compare?with={number}').json() == []
    robots.values |= {'rest.arrival': 3.0, 'rate': 5.0}
    told = browser.get(f'{PLACE}/compare?with={number}').json()
    assert {(row['name'], row['saved'], row['now']) for row in told} == {
        ('rest.arrival', 1.0, 3.0), ('rate', 10.0, 5.0),
    }  # fmt: skip
    answer = browser.act(f'{PLACE}/revert', {'id': number}).json()
    assert answer['at_start_only'] == ['motion_generator rate']
    assert robots.asked[-1][2]['values'] == {'rest.arrival': 1.0}


@pytest.mark.parametrize('number', ['', '-1', 'x', '99', '1e3', '9' * 40])
def test_a_save_that_is_not_there_is_told(browser, number):
    assert browser.get(f'{PLACE}/compare?with={number}').status_code in {404, 422}


@pytest.mark.parametrize('number', [0, -1, True, 10**30, '1', None])
def test_a_number_of_no_save_is_reverted_to_by_nobody(browser, robots, number):
    answer = browser.act(f'{PLACE}/revert', {'id': number})
    assert answer.status_code == 422
    assert 'expected the number of a save' in answer.json()['error']
    assert robots.asked == []


def test_parameters_are_shown_to_who_asks_for_them(browser):
    with browser.look() as live:
        live.receive_json()
        live.send_json({'want': ['oak/parameters', 7, None, 'no/such', {}]})
        topics = set()
        while ('oak', 'parameters') not in topics:
            told = live.receive_json()
            live.send_json({'ack': told['n']})
            topics = {(one['robot'], one['topic']) for one in told['updates']}
    assert ('ash', 'parameters') not in topics


def test_a_mark_is_kept_and_published(browser, robots):
    clock = SimpleNamespace(clock=SimpleNamespace(sec=1434366000, nanosec=0))
    robots.say('', 'clock', clock)
    robots.board.look(robots.time + 1.0)  # later than the last look of the page
    assert browser.act('/mark', {'text': 'look\nhere <b>'}).status_code == 202
    assert robots.asked == [('', 'mark', {'text': 'look here <b>'})]
    with browser.look() as live:
        live.receive_json()
        told = live.receive_json()['updates']
    marks = next(one['value'] for one in told if one['topic'] == 'marks')
    assert [(m['at'], m['text'], m['by']) for m in marks] == [
        (1434366000.0, 'look here <b>', 'local')
    ]


def test_hours_are_set_with_one_word(browser, robots):
    assert (
        browser.act('/hours', {'robot': 'oak', 'open': 10.5, 'close': '18:00'}).status_code == 202
    )
    assert robots.asked[0][2]['values'] == {
        'schedule.enabled': True, 'schedule.opens': '10:30', 'schedule.closes': '18:00',
    }  # fmt: skip


SQUARE = [[0, 0], [9, 0], [9, 9], [0, 9]]


def test_a_zone_goes_to_the_robot_as_text(browser, robots):
    told = {'robot': 'oak', 'zone': {'boundary': SQUARE, 'margin': 0.5, 'home': None}}
    assert browser.act('/zone', told).status_code == 202
    assert robots.asked[0][2]['values'] == {
        'zone': '{"boundary": [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]], "margin": 0.5}'
    }


@pytest.mark.parametrize(
    'zone',
    [None, [], {}, {'boundary': []}, {'boundary': [[0, 0], [1, 0], [1, 'x']]}, {'file': '/etc'},
     {'boundary': SQUARE, 'holes': [[1]]}, {'boundary': SQUARE, 'margin': -1}],
)  # fmt: skip
def test_what_is_no_zone_is_refused(browser, robots, zone):
    assert browser.act('/zone', {'robot': 'oak', 'zone': zone}).status_code == 422
    assert robots.asked == []


def test_a_rest_until_a_time_is_a_parameter_of_the_tree(browser, robots):
    assert browser.act('/robots/oak/rest', {'until': 1.5e9}).status_code == 202
    assert robots.asked[0][2]['values'] == {'rest_until': 1.5e9}
