"""Alerts on the page: raised by the robot's reasons, acknowledged, kept over a restart."""

from __future__ import annotations

import pytest

from agv_motion.dashboard.server.alerts import AlertDesk
from agv_motion.dashboard.server.site import Site


def say_why(robots, messages, at, level=2):
    links = [messages.status('headline', level, 'it stands'),
             messages.status('probe 2', level, 'probe 2 is off'),
             messages.status('wheels', level, 'wheels stand', because='probe 2')]  # fmt: skip
    robots.time = at
    robots.say('oak', 'why', messages.diagnostics(*links))


@pytest.fixture
def troubled(site, robots, messages):
    desk = AlertDesk(site)
    for at in (1000.0, 1001.0, 1002.0, 1003.0):
        say_why(robots, messages, at)
        desk.look(at)
    return desk


def test_a_first_cause_is_one_alert(troubled):
    told = [(a['robot'], a['level'], a['sentence'], a['cleared']) for a in troubled.alerts()]
    assert told == [('oak', 'ERROR', 'probe 2 is off', None)]


def test_it_is_over_when_all_is_well_for_a_while(troubled, robots, messages):
    for at in (1004.0, 1008.0, 1012.0):
        say_why(robots, messages, at, level=0)
        troubled.look(at)
    assert troubled.alerts()[0]['cleared'] == 1004.0


def test_who_acknowledged_it_is_known_after_a_restart(site, troubled, robots):
    number = troubled.alerts()[0]['id']
    troubled.acknowledge(number, 'anna')
    again = AlertDesk(Site(robots, site.access, site.store))
    assert [(a['id'], a['by']) for a in again.alerts()] == [(number, 'anna')]


def test_an_alert_that_is_not_there_cannot_be_acknowledged(browser):
    assert browser.act('/alerts/no/such/acknowledge').status_code == 404


def test_reports_are_listed_and_shown_in_a_sandbox(site, browser, tmp_path):
    site.reports = tmp_path / 'reports'
    assert browser.get('/reports').json() == []
    site.reports.mkdir()
    for name in ('2026-11-29.html', '2026-11-30.html', 'notes.txt', '.2026-11-28.html'):
        (site.reports / name).write_text('<style>p {}</style><p>all well')
    (site.reports / '2026-11-27.html').symlink_to('/etc/passwd')
    assert [one['date'] for one in browser.get('/reports').json()] == ['2026-11-30', '2026-11-29']
    answer = browser.get('/reports/2026-11-30.html')
    assert 'all well' in answer.text
    assert 'sandbox' in answer.headers['content-security-policy']
    assert 'script' not in answer.headers['content-security-policy']
    for name in ('notes.txt', '2026-11-27.html', '..%2f..%2fetc%2fpasswd', '2026-11-01.html'):
        assert browser.get(f'/reports/{name}').status_code == 404
