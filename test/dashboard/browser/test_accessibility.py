"""The page for those who do not see, do not point, or do not see colours: axe, and keys alone."""

from __future__ import annotations

import json

import pytest

RULES = {
    'resultTypes': ['violations'],
    'rules': {'color-contrast-enhanced': {'enabled': True}},  # 7:1, 4.5:1 for large letters
}
OF_COLOURS = {
    'resultTypes': ['violations'],
    # the second leaves to the first what has not even 4.5:1, 3:1 for large letters
    'runOnly': ['color-contrast', 'color-contrast-enhanced'],
}
"""what can differ between light and dark"""


def violations(page, *parts, rules=RULES):
    """Return what axe-core finds that is serious in the page or in parts of it, with where."""
    axe = pytest.importorskip('axe_playwright_python.sync_playwright').Axe()
    if not page.evaluate('Boolean(window.axe)'):
        page.evaluate(axe.axe_script)
    within = [[part] for part in parts] or [['html']]
    run = 'async ([within, rules]) => (await axe.run({ include: within }, rules)).violations'
    found = page.evaluate(run, [within, rules])
    return [
        (one['id'], node['target'], node.get('failureSummary', '')[:200])
        for one in found
        if one['impact'] in {'serious', 'critical'}
        for node in one['nodes']
    ]


def test_axe_finds_nothing_serious(park, serve, open_page):
    """In light, and what can differ in the dark there too: both in each state of the page."""
    url = serve(park).url
    page = open_page(url)

    def found(*parts):
        light = violations(page, *parts)
        page.emulate_media(color_scheme='dark')
        dark = violations(page, *parts, rules=OF_COLOURS)
        page.emulate_media(color_scheme='light')
        return light + dark

    page.wait_for_selector('[data-act=drive]')
    for colour, word in (('green', 'walking'), ('yellow', 'waiting'), ('red', 'blocked')):
        park.tell('oak', colour=colour, word=word)
        page.wait_for_selector(f'body[data-colour={colour}]')
        assert found(*(('.bar', '.stop', '.side') if colour != 'green' else ())) == []
    for name in ('why', 'probes', 'health', 'parameters', 'zone', 'log'):
        page.click(f'[data-drawer={name}]')
        assert found('#drawer', '#drawer-tabs') == [], name
    page.click('#drawer-close')
    page.click('[data-act=drive]')
    assert found('.drive') == []
    page.goto(f'{url}/public')
    page.wait_for_selector('.public-name')
    assert found() == []
    page.goto(f'{url}/login')
    page.wait_for_selector('h1:not(:empty)')
    assert found() == []


def focused(page):
    return page.evaluate(
        """() => {
          const one = document.activeElement;
          const style = getComputedStyle(one);
          const seen = one.matches(':focus-visible') && style.outlineStyle !== 'none';
          return [one.id || one.dataset.act || one.dataset.robot || one.dataset.drawer
            || one.getAttribute('aria-label') || one.tagName, seen];
        }"""
    )


def test_keys_alone_reach_everything_and_the_focus_is_seen(park, serve, open_page):
    page = open_page(serve(park).url)
    page.wait_for_selector('[data-act=drive]')
    order = []
    for _ in range(45):
        page.keyboard.press('Tab')
        name, seen = focused(page)
        if name == 'BODY':
            break
        assert seen, f'the focus on {name} is not seen'
        order.append(name)
    for name in ('stop-button', 'map-canvas', 'oak', 'pause', 'drive', 'look-slider', 'why'):
        assert name in order, json.dumps(order)
    assert order.index('stop-button') < order.index('map-canvas') < order.index('oak')


def test_keys_alone_choose_a_robot_send_it_and_stop_all(park, serve, open_page, wait_until):
    page = open_page(serve(park).url)
    page.wait_for_selector('[data-act=drive]')
    page.focus('[data-robot=oak]')
    page.keyboard.press('ArrowDown')
    page.wait_for_selector('[data-robot=ash][aria-checked=true]')
    page.focus('#map-canvas')
    page.keyboard.press('ArrowRight')
    page.keyboard.press('Enter')
    page.wait_for_selector('#map-question .primary:focus')
    page.keyboard.press('Enter')
    page.wait_for_selector('.outcome')
    wait_until(lambda: park.asked[:1] and park.asked[0][:2] == ('ash', 'goal'), 20.0)
    page.keyboard.press('Escape')
    page.wait_for_selector('[data-state=stopping]')
    stopped = {(robot, 'stop') for robot in ('oak', 'ash', 'elm')}
    wait_until(lambda: {asked[:2] for asked in park.asked} >= stopped, 20.0)


def test_sentence_is_told_to_a_screen_reader(park, serve, open_page):
    from playwright.sync_api import expect

    page = open_page(serve(park).url)
    live = page.locator('[aria-live=polite]#announcer')
    expect(live).to_have_text('oak walking. walking to the sun')
    park.tell('ash', 1, colour='red', word='blocked', sentence='blocked: no way to (3, 2)')
    expect(live).to_have_text('ash blocked. blocked: no way to (3, 2)')
