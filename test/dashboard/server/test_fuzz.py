"""Whatever comes to a door: an answer that says what is wrong, and nothing moves."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

PATHS = (
    '/stop', '/release', '/robots/oak/goal', '/robots/oak/pose', '/robots/oak/rest', '/mark',
    '/robots/oak/parameters', '/robots/oak/parameters/save', '/robots/oak/parameters/revert',
    '/zone', '/hours', '/history/save', '/alerts/x/acknowledge', '/login', '/logout',
)  # fmt: skip
KEYS = (
    'x', 'y', 'heading', 'until', 'node', 'name', 'value', 'comment', 'id', 'text', 'zone',
    'robot', 'open', 'close', 'days', 'begin', 'end', 'user', 'password', 'everywhere',
)  # fmt: skip
SIMPLE = st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=30)
JSON = st.recursive(
    SIMPLE, lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner),
    max_leaves=8,
)  # fmt: skip
TOLD = st.dictionaries(st.sampled_from(KEYS), JSON, max_size=4) | JSON
QUICKLY = settings(
    max_examples=60,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


@pytest.fixture
def patient(open_browser):
    """Return a browser for which no flood counts, and its token."""
    clock = iter(range(10**9))
    with open_browser(clock=lambda: 10.0 * next(clock)) as browser:
        yield browser, browser.hello()['csrf']


@QUICKLY
@given(st.sampled_from(PATHS), TOLD, st.integers(0, 10**12))
def test_no_door_fails_whatever_it_is_told(patient, path, told, key):
    import json

    browser, token = patient
    headers = {'X-CSRF-Token': token, 'Idempotency-Key': f'key-{key:012}',
               'content-type': 'application/json'}  # fmt: skip
    answer = browser.post(path, content=json.dumps(told), headers=headers)
    assert answer.status_code < 500 or answer.status_code == 503
    if answer.status_code >= 400:
        assert answer.json()['error']
    assert 'Traceback' not in answer.text


@QUICKLY
@given(st.binary(max_size=200), st.sampled_from(PATHS))
def test_no_bytes_move_a_robot(patient, robots, body, path):
    browser, token = patient
    robots.asked.clear()
    headers = {'X-CSRF-Token': token, 'Idempotency-Key': 'key-00000001'}
    answer = browser.post(path, content=b'\xff' + body, headers=headers)
    assert answer.status_code in {400, 401, 415, 429}
    assert robots.asked == []


@QUICKLY
@given(st.text(max_size=60))
def test_no_address_fails(patient, address):
    from urllib.parse import quote

    browser, _ = patient
    assert browser.get(f'/{quote(address)}', follow_redirects=False).status_code < 500
