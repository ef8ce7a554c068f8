"""Pages of others, names of others, floods, bodies without end: none of them passes."""

from __future__ import annotations

import pytest
from starlette.websockets import WebSocketDisconnect

KEY = {'Idempotency-Key': 'k' * 10}


@pytest.mark.parametrize(
    'origin',
    ['http://evil.example', 'null', 'https://127.0.0.1:8080', 'http://127.0.0.1:8081', '',
     'http://127.0.0.1:8080.evil.example', 'http://localhost:8080'],
)  # fmt: skip
def test_a_foreign_page_neither_acts_nor_looks(browser, robots, origin):
    token = {'X-CSRF-Token': browser.hello()['csrf']}
    answer = browser.post('/stop', json={}, headers=KEY | token | {'origin': origin})
    assert answer.status_code == 403
    assert robots.asked == []
    for path in ('/live', '/robots/oak/drive'):
        with pytest.raises(WebSocketDisconnect), browser.socket(path, origin=origin):
            pass


@pytest.mark.parametrize('told', ['cross-site', 'same-site'])
def test_a_foreign_page_is_known_without_its_origin(browser, robots, told):
    token = {'X-CSRF-Token': browser.hello()['csrf'], 'sec-fetch-site': told}
    del browser.headers['origin']
    assert browser.post('/stop', json={}, headers=KEY | token).status_code == 403
    assert robots.asked == []


@pytest.mark.parametrize(
    'host', ['evil.example', 'evil.example:8080', 'a b', '', '127.0.0.1.nip.io']
)
def test_a_name_that_is_not_ours_is_refused(browser, host):
    """A name that an attacker has bound to this machine must not reach it (DNS rebinding)."""
    answer = browser.get('/', headers={'host': host})
    assert answer.status_code == 421
    with pytest.raises(WebSocketDisconnect), browser.socket('/live', host=host):
        pass


@pytest.mark.parametrize('host', ['localhost:8080', '127.0.0.1', '[::1]:8080', '192.168.1.7:80'])
def test_our_own_names_are_not_refused(browser, host):
    assert browser.get('/health', headers={'host': host}).status_code == 200


def test_a_body_without_end_is_refused(browser, robots):
    token = {'X-CSRF-Token': browser.hello()['csrf']}
    big = b'{"x": "' + b'a' * 200_000 + b'"}'
    told = browser.post('/robots/oak/goal', content=big, headers=KEY | token)
    assert told.status_code == 413
    untold = browser.post(
        '/robots/oak/goal', content=(big[i : i + 9000] for i in range(0, len(big), 9000)),
        headers=KEY | token,
    )  # fmt: skip
    assert untold.status_code == 413
    assert robots.asked == []


def test_a_flood_is_slowed_and_does_not_keep_anybody_from_stop(open_browser, robots):
    with open_browser(clock=lambda: 0.0) as browser:
        token = {'X-CSRF-Token': browser.hello()['csrf']}
        answers = [
            browser.post(
                '/robots/oak/home', json={}, headers=token | {'Idempotency-Key': f'k{i:010}'}
            ).status_code
            for i in range(62)
        ]
        assert answers == [202] * 60 + [429] * 2
        assert browser.post('/stop', json={}, headers=token).status_code == 202
    assert {what for _, what, _ in robots.asked} == {'home', 'stop'}


@pytest.mark.parametrize('path', ['/', '/health', '/no/such', '/static/no.js'])
def test_every_answer_has_the_headers_of_a_page_that_keeps_to_itself(browser, path):
    headers = browser.get(path).headers
    policy = headers['content-security-policy']
    assert "default-src 'none'" in policy
    assert "frame-ancestors 'none'" in policy
    assert 'unsafe' not in policy
    assert headers['x-content-type-options'] == 'nosniff'
    assert headers['referrer-policy'] == 'no-referrer'
    assert headers['x-frame-options'] == 'DENY'


@pytest.mark.parametrize('method', ['PUT', 'DELETE', 'PATCH', 'TRACE', 'OPTIONS', 'CONNECT', 'FOO'])
def test_a_method_that_nobody_uses_is_refused(browser, method):
    answer = browser.request(method, '/stop')
    assert answer.status_code == 405
    assert 'access-control-allow-origin' not in answer.headers


@pytest.mark.parametrize(
    'path',
    ['/static/../server/app.py', '/static/..%2fserver/app.py', '/static/%2e%2e/server/app.py',
     '/static//etc/passwd', '/static/....//server/app.py', '/static/%00', '/static/..\\server'],
)  # fmt: skip
def test_no_path_leads_out_of_the_folder_of_the_page(browser, path):
    assert browser.get(path).status_code == 404
