"""Tablet and phone: nothing is cut off, nothing covers another, all is large enough for a thumb."""

from __future__ import annotations

import pytest

TABLET, PHONE = {'width': 1024, 'height': 768}, {'width': 390, 'height': 844}
LARGEST = {'width': 1920, 'height': 1080}
SMALL_PHONE = {'width': 360, 'height': 640}
ON_ITS_SIDE, ENLARGED = {'width': 844, 'height': 390}, {'width': 640, 'height': 400}
PARTS = '.bar', '.stop', '.map', '.side', '.look-back', '.drawer-tabs'
THUMB = 47.5
"""[px] of 48: a browser rounds"""
LONG = 'resting: probe 2 is off since 14:02: look at its heater, its cable and the logger at home'

BOXES = """(selectors) => selectors.map((selector) => {
  const box = document.querySelector(selector).getBoundingClientRect();
  return [selector, box.left, box.top, box.right, box.bottom];
})"""
CUT = """() => [...document.querySelectorAll('button, .bar-title, .bar-clock, .stop-label, h2')]
  .filter((one) => one.offsetParent && one.scrollWidth > one.clientWidth + 1)
  .map((one) => one.id + one.className + one.textContent)"""
SMALL = """(least) => [...document.querySelectorAll('button, a, select, input, summary')]
  .filter((one) => one.offsetParent && !one.matches('input[type=checkbox]'))
  .map((one) => [one.id + one.className + one.textContent, one.getBoundingClientRect()])
  .filter(([, box]) => box.height < least || box.width < Math.min(least, 44))
  .map(([name, box]) => `${name} ${box.width} x ${box.height}`)"""
IN_SIGHT = """() => {
  const stop = document.querySelector('#stop-button');
  const box = stop.getBoundingClientRect();
  const at = (part) => [box.left + part * box.width, box.top + part * box.height];
  return [0.1, 0.5, 0.9].every((part) => stop.contains(document.elementFromPoint(...at(part))));
}"""
REACHED = """(selector) => {
  const part = document.querySelector(selector);
  const box = part.getBoundingClientRect();
  return part.contains(document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2));
}"""
OPEN = """(selector) => new Promise((resolve) => {
  document.querySelector(selector).click();
  requestAnimationFrame(() => requestAnimationFrame(resolve));
})"""


def overlaps(first, second):
    return (
        min(first[3], second[3]) - max(first[1], second[1]) > 0.5
        and min(first[4], second[4]) - max(first[2], second[2]) > 0.5
    )


def assert_nothing_is_cut_off_or_covers_another(page, size):
    boxes = page.evaluate(BOXES, list(PARTS))
    for name, left, top, right, bottom in boxes:
        room = left, top, size['width'] - right, size['height'] - bottom
        assert min(room) >= -0.5, name
    pairs = [(one, two) for i, one in enumerate(boxes) for two in boxes[i + 1 :]]
    assert [(one[0], two[0]) for one, two in pairs if overlaps(one, two)] == []
    assert page.evaluate(CUT) == []
    assert page.evaluate(SMALL, THUMB) == []
    width = page.evaluate('document.documentElement.scrollWidth')
    assert width <= size['width'], 'the page is wider than the screen'
    stop = page.locator('#stop-button').bounding_box()
    assert stop['width'] >= 150
    assert stop['height'] >= 70


@pytest.mark.parametrize('size', [TABLET, PHONE, LARGEST], ids=['tablet', 'phone', 'large'])
def test_nothing_covers_another_and_stop_stays_in_sight_whatever_is_open(
    park, serve, open_page, size
):
    park.tell('ash', 1, colour='yellow', word='resting', sentence=LONG)
    page = open_page(serve(park).url, size)
    page.wait_for_selector('[data-act=drive]')
    assert_nothing_is_cut_off_or_covers_another(page, size)
    if size == TABLET:  # it shows three robots whole, where none has that much to say
        park.tell('ash', 1)
        page.wait_for_selector(f'text={LONG}', state='detached')
        page.wait_for_selector('text=Drank today')
        last, room = (page.locator(each).bounding_box() for each in ('[data-robot=elm]', '.robots'))
        assert last['y'] + last['height'] <= room['y'] + room['height']
    tabs = ['why', 'probes', 'health', 'parameters', 'zone', 'log', 'reports']
    opened = ['[data-act=drive]', *(f'[data-drawer={tab}]' for tab in tabs), '#drawer-close']
    for selector in (*opened, '[data-act=rest]', '#look-mark'):
        page.evaluate(OPEN, selector)
        assert page.evaluate(IN_SIGHT), selector
        assert page.evaluate(CUT) == [], selector


def test_ten_robots_with_long_names_have_room(make_park, serve, open_page):
    park = make_park(*(f'a_tree_with_a_name_of_many_letters_{i}' for i in range(10)))
    park.tell_all()
    page = open_page(serve(park).url, PHONE)
    last = '[data-robot=a_tree_with_a_name_of_many_letters_9]'
    page.wait_for_selector(last)
    for selector in (last, '[data-act=drive]', '#drive-close', '[data-drawer=why]'):
        page.evaluate(OPEN, selector)
        assert page.evaluate(IN_SIGHT), selector
        assert page.evaluate(CUT) == [], selector
    assert page.get_attribute(last, 'aria-checked') == 'true'
    close = page.locator('#drawer-close').bounding_box()
    assert close['x'] + close['width'] <= PHONE['width']


@pytest.mark.parametrize('size', [TABLET, SMALL_PHONE], ids=['tablet', 'phone'])
def test_robots_that_differ_in_their_last_letters_are_told_apart_beside_their_words(
    make_park, serve, open_page, size
):
    names = [f'building_north_tree_{i}' for i in (1, 2)] + ['z' * 60]
    park = make_park(*names)
    park.tell_all()
    park.sum_up(names[2], colour='red', word='stopped', sentence='probe 2 is off')
    page = open_page(serve(park).url, size)
    page.wait_for_selector('#bar-word:text("stopped")')
    shown = page.locator('.robot-name > [aria-hidden]').all_inner_texts()
    assert shown == ['buildin…tree_1', 'buildin…tree_2', 'zzzzzzz…zzzzzz']
    bar, word = (page.locator(each).bounding_box() for each in ('.bar-title', '#bar-word'))
    assert word['y'] + word['height'] <= bar['y'] + bar['height'] + 4.0, 'the word is cut off'
    parts = '.robot-name', '.robot-word', '.robot-speed', '.robot-sentence'
    row = '[data-robot=building_north_tree_1] > '
    page.wait_for_selector(f'{row}.robot-word:text("walking")')
    boxes = page.evaluate(BOXES, [row + part for part in parts])
    pairs = [(one, two) for i, one in enumerate(boxes) for two in boxes[i + 1 :]]
    assert [(one[0], two[0]) for one, two in pairs if overlaps(one, two)] == []


@pytest.mark.parametrize('size', [ON_ITS_SIDE, ENLARGED], ids=['on its side', 'enlarged'])
def test_a_low_screen_is_scrolled_to_all_that_it_has_no_room_for_and_stop_stays(
    park, serve, open_page, size
):
    page = open_page(serve(park).url, size)
    page.wait_for_selector('[data-act=drive]')
    for selector in ('.map', '[data-act=drive]', '[data-drawer=reports]', '#bar-name'):
        part = page.locator(selector)
        part.scroll_into_view_if_needed()
        assert part.bounding_box()['height'] >= (200 if selector == '.map' else 20), selector
        assert page.evaluate(REACHED, selector), selector
        assert page.evaluate(IN_SIGHT), selector
    assert page.evaluate('document.documentElement.scrollWidth') <= size['width']
