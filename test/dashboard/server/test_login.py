"""Sessions and roles, as browsers on other machines see them."""

from __future__ import annotations

import time

import pytest
from starlette.websockets import WebSocketDisconnect

from agv_motion.dashboard.server.access import Access
from agv_motion.errors import ConfigurationError


def test_who_has_not_logged_in_sees_the_public_view_alone(visit, robots, messages):
    browser = visit()
    assert browser.get('/', follow_redirects=False).headers['location'] == '/login'
    robots.say('oak', 'pose', messages.pose())
    robots.say('oak', 'driver', messages.status('driver', message='the agent drives'))
    with browser.look() as live:
        hello = live.receive_json()
        assert (hello['role'], hello['csrf'], hello['user']) == ('public', '', '')
        topics = {one['topic'] for one in live.receive_json()['updates']}
    assert {'pose', 'summary'} <= topics
    assert not topics & {'driver', 'why', 'health', 'alerts', 'marks', 'parameters'}
    assert browser.act('/stop').status_code == 401
    with pytest.raises(WebSocketDisconnect), browser.socket('/robots/oak/drive'):
        pass
    assert robots.asked == []


@pytest.mark.parametrize(
    ('user', 'status'), [('viewers', 403), ('operators', 202), ('experts', 202)]
)
def test_each_role_may_what_it_may(visit, robots, user, status):
    assert visit(user).act('/stop').status_code == status
    assert bool(robots.asked) is (status == 202)


@pytest.mark.parametrize(
    'told',
    [{'user': 'operators', 'password': 'wrong'}, {'user': 'nobody', 'password': 'wrong'},
     {'user': 'operators', 'password': 'x' * 5000}, {'user': "' OR 1=1 --", 'password': ''},
     {'user': 'operators', 'password': None}],
)  # fmt: skip
def test_a_wrong_login_is_told_in_the_same_words_whatever_is_wrong(visit, told):
    answer = visit().post('/login', json=told)
    assert answer.status_code == 401
    assert answer.json() == {'error': 'user or password is wrong'}
    assert 'set-cookie' not in answer.headers


def test_a_password_with_half_a_character_is_refused(visit):
    answer = visit().post('/login', content=b'{"user": "operators", "password": "\\ud800"}')
    assert answer.status_code == 400
    assert 'surrogates' in answer.json()['error']


def test_guessing_is_slowed(visit):
    browser = visit()
    told = {'user': 'operators', 'password': 'a wrong guess'}
    assert 429 in [browser.post('/login', json=told).status_code for _ in range(12)]


def test_the_cookie_is_out_of_reach_for_scripts_and_other_sites(visit):
    answer = visit().post('/login', json={'user': 'viewers', 'password': 'a blue gate, 1905'})
    cookie = answer.headers['set-cookie'].lower()
    assert 'httponly' in cookie
    assert 'samesite=strict' in cookie
    assert 'max-age' in cookie


def test_a_token_of_one_session_is_of_no_use_to_another(visit, robots):
    one, other = visit('operators'), visit('experts')
    token = one.hello()['csrf']
    assert other.act('/stop', **{'X-CSRF-Token': token}).status_code == 403
    assert robots.asked == []


def test_logging_out_ends_a_stolen_session_too(visit):
    browser, thief = visit('operators'), visit()
    thief.cookies = browser.cookies
    assert thief.hello()['role'] == 'operator'
    assert browser.act('/logout').status_code == 202
    assert thief.hello()['role'] == 'public'


def test_logging_out_everywhere_ends_all_sessions_of_the_user(visit):
    tablet, phone, other = visit('operators'), visit('operators'), visit('viewers')
    assert tablet.act('/logout', {'everywhere': True}).status_code == 202
    assert phone.hello()['role'] == 'public'
    assert other.hello()['role'] == 'viewer'


def test_a_session_ends_by_itself(visit, guarded, monkeypatch):
    browser = visit('operators')
    later = time.time() + 12 * 3600 + 1
    monkeypatch.setattr(guarded.access.users, '_clock', lambda: later)
    assert browser.hello()['role'] == 'public'


def test_another_role_counts_at_once(visit, guarded):
    browser = visit('operators')
    guarded.access.users.set_role('operators', 'viewer')
    assert browser.act('/stop').status_code == 403


@pytest.mark.parametrize('host', ['192.168.1.4', '::', 'robots.example'])
def test_beyond_this_machine_a_user_is_needed(host):
    with pytest.raises(ConfigurationError, match='agv dashboard user add NAME'):
        Access(host, None)


def test_without_users_only_this_machine_may_act(open_browser, robots):
    with open_browser(client='10.0.0.7') as other:
        assert other.hello()['role'] == 'public'
        assert other.act('/stop').status_code == 401
    assert robots.asked == []
