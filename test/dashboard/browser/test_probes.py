"""Probes and the day of sap flow: what is unknown, what is alone, and whose it is."""

from __future__ import annotations

INK = """([column, row]) => {
  const chart = document.querySelector('canvas.chart');
  const ratio = chart.width / chart.clientWidth;
  const at = [46 + column * (chart.clientWidth - 138), 12 + (1 - row) * 134];
  return chart.getContext('2d').getImageData(at[0] * ratio, at[1] * ratio, 1, 1).data[3];
}"""
"""how dark the chart is at a share of its width and at a value, by the margins of chart.js"""
CUT = """() => [...document.querySelectorAll('.meter output, .probe-signal, .probe-value')]
  .filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.textContent)"""


def open_probes(park, serve, open_page):
    page = open_page(serve(park).url)
    page.wait_for_selector('[data-act=drive]')
    page.click('[data-drawer=probes]')
    page.wait_for_selector('.meter')
    return page


def test_what_is_unknown_is_not_cut_off(park, serve, open_page):
    probe = {'name': 'probe_1', 'temperature_difference': None, 'quality': 'bad', 'signal': None}
    park.say('oak', 'probes', {'probes': [probe]})
    page = open_probes(park, serve, open_page)
    page.wait_for_selector('.probe-signal:text("unknown")')
    assert page.locator('.meter output').all_inner_texts()[2] == 'unknown'
    assert page.evaluate(CUT) == []


def test_a_value_alone_between_gaps_is_seen_and_a_gap_stays_one(park, serve, open_page):
    times = [3600.0 * hour for hour in range(5)]
    flow = [None, None, 0.6, None, 0.9]
    park.say('oak', 'day', {'times': times, 's1': flow, 's2': [None] * 5, 's3': [None] * 5})
    page = open_probes(park, serve, open_page)
    page.wait_for_selector('[aria-label*="s1 0.90"]')
    assert page.evaluate(INK, [0.5, 0.6]) > 200
    assert page.evaluate(INK, [0.75, 0.7]) == 0


def test_a_robot_that_tells_no_day_does_not_show_that_of_another(make_park, serve, open_page):
    park = make_park('oak', 'ash')
    park.tell_all()
    del park.board.cells['ash', 'day']
    page = open_probes(park, serve, open_page)
    page.wait_for_selector('[aria-label*="s1 0.90"]')
    page.select_option('.drawer select', 'ash')
    page.wait_for_selector('canvas.chart[aria-label="Sap flow"]')
