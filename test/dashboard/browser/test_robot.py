"""A real tree behind the page: STOP and the dead-man, from the hand to the wheels' command.

launch_scripts/page/trial_page.py is the long form, with figures.
"""

from __future__ import annotations

import signal
import time
from contextlib import ExitStack

import pytest

pytest.importorskip('rclpy')

BUSY = 3.0
"""[s] that a machine busy with other things may take; the long form has the true limits"""


@pytest.fixture(scope='module')
def rig(chromium, tmp_path_factory):
    """Return a tree, a server and a cable; one of each for all tests here."""
    import page_rig

    with page_rig.rig(chromium, tmp_path_factory.mktemp('state')) as found:
        yield found


@pytest.fixture(scope='module')
def look(rig):
    """Return what looks at the page: the one that is open, until that is closed."""
    pages = []
    with ExitStack() as stack:

        def looked_at():
            if not pages or pages[-1].is_closed():
                pages.append(stack.enter_context(rig.page()))
            return pages[-1]

        yield looked_at


@pytest.fixture
def driving(rig, look):
    """Return a page whose drive panel is open, and a tree that stands."""
    rig.wheels.walking = False
    page = look()
    if page.locator('.drive-surface').is_visible():
        page.locator('.drive-state', has_text='hold to drive').wait_for()
    else:
        rig.open_drive(page)
    yield page
    rig.wheels.stood_after(time.time())


def test_stop_makes_the_wheels_stand_and_release_lets_them_go(rig, look):
    import page_rig

    rig.wheels.walking = True
    page = look()
    for way in ('click', 'Escape'):
        rig.wheels.wait(rig.wheels.rolls)
        if way == 'click':
            page.click('#stop-button')
        else:
            page.keyboard.press(way)
        assert rig.wheels.stood_after(page_rig.acted(page)) < 0.2 + BUSY
        page.locator('#stop[data-state=stopped]').wait_for()
        page.click('#stop-release')
        page.locator('dialog .primary').click()
        page.locator('#stop[data-state=ready]').wait_for()
    rig.wheels.wait(rig.wheels.rolls)
    rig.wheels.walking = False


def test_stick_let_go_stops(rig, driving):
    import page_rig

    rig.press(driving)
    driving.locator('.drive dd', has_text='manual drives').wait_for()
    driving.mouse.up()
    assert rig.wheels.stood_after(page_rig.acted(driving)) < 0.5 + BUSY


def test_space_bar_let_go_stops(rig, driving):
    import page_rig

    driving.focus('.drive-surface')
    driving.keyboard.down('ArrowUp')
    assert not rig.wheels.rolls()
    driving.keyboard.down('Space')
    rig.wheels.wait(rig.wheels.rolls)
    driving.keyboard.up('Space')
    assert rig.wheels.stood_after(page_rig.acted(driving)) < 0.5 + BUSY
    driving.keyboard.up('ArrowUp')


def test_focus_that_goes_elsewhere_stops(rig, driving):
    driving.focus('.drive-surface')
    driving.keyboard.down('Space')
    driving.keyboard.down('ArrowUp')
    rig.wheels.wait(rig.wheels.rolls)
    moment = time.time()
    driving.evaluate('document.activeElement.blur()')
    assert rig.wheels.stood_after(moment) < 0.5 + BUSY
    driving.keyboard.up('ArrowUp')
    driving.keyboard.up('Space')


def test_closed_tab_stops(rig, driving):
    rig.press(driving)
    moment = time.time()
    driving.close()
    assert rig.wheels.stood_after(moment) < 0.5 + BUSY


def test_cut_network_stops_and_the_page_says_so(rig, driving):
    rig.press(driving)
    moment = time.time()
    rig.cable.cut()
    assert rig.wheels.stood_after(moment) < 0.5 + BUSY
    driving.locator('body[data-stale]').wait_for()
    driving.mouse.up()
    rig.cable.mend()
    driving.locator('body:not([data-stale])').wait_for()


def test_killed_server_stops_and_the_page_says_so(rig, driving):
    """Last of all: that a page comes back with the next server is seen in test_page.py."""
    rig.press(driving)
    moment = time.time()
    rig.server.end(signal.SIGKILL)
    assert rig.wheels.stood_after(moment) < 0.5 + BUSY
    driving.mouse.up()
    driving.locator('body[data-stale]').wait_for()
