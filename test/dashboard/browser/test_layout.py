"""Tablet and phone: nothing is cut off, nothing covers another, all is large enough for a thumb."""

from __future__ import annotations

import pytest

TABLET, PHONE = {'width': 1024, 'height': 768}, {'width': 390, 'height': 844}
LARGEST = {'width': 1920, 'height': 1080}
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
