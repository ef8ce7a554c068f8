"""What each role finds in the page; the server refuses the rest anyway."""

from __future__ import annotations

import pytest

ACTING = (
    '#stop-button, #stop-release, [data-act], #look-mark:not([hidden]), #look-save:not([hidden])'
)
ROLES = 'viewer', 'operator', 'expert'


@pytest.fixture
def page_of(park, serve, open_page, log_in):
    url = serve(park, ROLES).url

    def make(role):
        page = open_page(url)
        assert page.url.endswith('/login')
        log_in(page, role)
        return page

    return make


def test_a_wrong_password_is_refused_in_words_and_a_viewer_has_nothing_that_acts(
    park, serve, open_page, log_in
):
    page = open_page(serve(park, ROLES).url)
    page.fill('#user', 'operators')
    page.fill('#password', 'wrong, but long enough')
    page.press('#password', 'Enter')
    page.wait_for_selector('#refusal:not(:empty)')
    assert page.url.endswith('/login')
    log_in(page, 'viewer')
    assert page.locator(ACTING).count() == 0
    page.click('[data-drawer=parameters]')
    page.wait_for_selector('.parameter')
    assert page.locator('.parameter input, .parameter button').count() == 0
    page.click('[data-drawer=zone]')
    assert page.locator('#zone-edit').count() == 0
    page.click('[data-drawer=zone]')
    page.locator('#map-canvas').click(position={'x': 400, 'y': 100})
    page.keyboard.press('Enter')
    page.keyboard.press('Escape')
    assert page.locator('#map-question button').count() == 0
    assert park.asked == []


def test_operator_acts_but_changes_no_parameter(page_of, park, wait_until):
    page = page_of('operator')
    assert page.locator('#stop-button').count() == 1
    page.click('[data-act=pause]')
    page.wait_for_selector('.outcome')
    wait_until(lambda: park.asked[:1] and park.asked[0][:2] == ('oak', 'pause'), 20.0)
    page.click('[data-drawer=parameters]')
    page.wait_for_selector('.parameter')
    assert page.locator('.parameter input, .parameter button').count() == 0


def test_expert_changes_parameters(page_of):
    page = page_of('expert')
    page.click('[data-drawer=parameters]')
    page.wait_for_selector('.parameter input')
    page.click('[data-drawer=zone]')
    page.wait_for_selector('#zone-edit')


def test_a_tab_whose_session_ended_in_another_says_that_stop_is_gone(page_of):
    page = page_of('operator')
    assert page.locator('.stop-lost').count() == 0
    other = page.context.new_page()
    other.goto(page.url)
    other.click('#bar-account button')
    other.wait_for_url('**/login')
    other.close()
    page.wait_for_selector('#stop-button', state='detached')
    lost = page.locator('.stop-lost[role=alert] > a')
    assert 'No STOP: the session has ended' in lost.inner_text()
    assert lost.bounding_box()['height'] >= 80
    lost.click()
    page.wait_for_url('**/login')
