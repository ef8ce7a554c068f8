"""What the page shows: the robots' words, their age, and nothing that they did not say."""

from __future__ import annotations

import re

PHONE = {'width': 390, 'height': 844}


def text(page, selector):
    return page.locator(selector).inner_text()


def wait_for_text(page, selector, wanted):
    """Wait until an element tells something; its text is then that."""
    from playwright.sync_api import expect

    expect(page.locator(selector)).to_contain_text(wanted)


def test_bar_tells_the_worst_robot_in_its_own_words_and_missing_numbers_are_unknown(
    park, serve, open_page
):
    park.tell('ash', 1, colour='yellow', word='waiting', sentence='waits for oak until 14:05')
    park.say('oak', 'twist', {'vx': None, 'vy': None, 'wz': None, 'icr': None})
    park.say('oak', 'pose', {'x': None, 'y': None, 'heading': None, 'covariance': [None] * 4})
    park.say('oak', 'turrets', {'angles': [None] * 3, 'speeds': [None] * 3})
    page = open_page(serve(park).url)
    wait_for_text(page, '#bar-sentence', 'waits for oak until 14:05')
    assert text(page, '#bar-name') == 'ash'
    assert text(page, '#bar-word') == 'waiting'
    assert page.get_attribute('body', 'data-colour') == 'yellow'
    wait_for_text(page, '#chosen .facts', 'unknown')
    assert '12.3\u202fL (3.8 to 39.4)' in text(page, '#chosen .facts')
    assert 'NaN' not in page.inner_text('body')
    assert 'oak unknown' in page.get_attribute('#map-canvas', 'aria-label')


def test_page_loads_quickly_and_asks_nothing_of_other_machines(park, serve, open_page):
    url = serve(park).url
    page = open_page('about:blank')
    asked = []
    page.on('request', lambda request: asked.append(request.url))
    page.goto(url)
    page.wait_for_selector('#bar-name:not(:empty)')
    seconds = page.evaluate('performance.now() / 1000')
    assert all(one.startswith((url, url.replace('http', 'ws'))) for one in asked), asked
    assert seconds < 20.0, f'{seconds:.1f} s'  # two on a quiet machine; see measure_page.py


def test_a_robot_whose_data_are_old_turns_red_though_frames_come(park, serve, open_page):
    page = open_page(serve(park).url)
    wait_for_text(page, '#bar-sentence', 'walking to the sun')
    park.silent.add('elm')
    wait_for_text(page, '#bar-sentence', 'Nothing heard from it since')
    assert text(page, '#bar-name') == 'elm'
    assert page.get_attribute('[data-robot=elm]', 'data-colour') == 'red'
    assert page.get_attribute('[data-robot=oak]', 'data-colour') == 'green'


def test_markup_in_names_and_sentences_is_text(make_park, serve, open_page):
    name = '<img src=x onerror="document.title=1">'
    park = make_park(name)
    park.tell_all(sentence='<b id=bold>bold</b>', word='<i>odd</i>')
    page = open_page(serve(park).url)
    wait_for_text(page, '#bar-sentence', '<b id=bold>bold</b>')
    assert page.get_attribute('#bar-name', 'title') == name
    assert text(page, '#bar-name') == '<img sr…le=1">'
    assert text(page, '#bar-word') == '<i>odd</i>'
    for drawer in page.locator('.tab').all():
        drawer.click()
    assert page.locator('#bold, img, i, b').count() == 0
    assert page.title() != '1'


STOPPED = {('oak', 'stop'), ('ash', 'stop'), ('elm', 'stop')}


def test_each_press_of_stop_is_sent_and_it_is_done_only_when_the_wheels_are_reported_to_stand(
    park, serve, open_page, wait_until
):
    page = open_page(serve(park).url)
    for presses in (1, 2, 3):  # however soon one follows the other
        with page.expect_response('**/stop'):
            page.click('#stop-button')
        wait_for_text(page, '.stop-label', 'STOPPING')
        wait_until(lambda count=3 * presses: len(park.asked) == count, 20.0)
    assert {asked[:2] for asked in park.asked} == STOPPED
    park.tell_all(stopped=True, standstill=False)
    wait_for_text(page, '.stop-note', 'oak, ash, elm')
    assert 'STOPPING' in text(page, '.stop-label')
    park.tell('oak', stopped=True, standstill=True, moving=False)
    wait_for_text(page, '.stop-note', 'ash, elm')
    park.tell_all(stopped=True, standstill=True, moving=False)
    wait_for_text(page, '.stop-label', 'STOPPED')


def test_without_a_server_the_page_says_so_and_the_next_one_takes_what_it_is_asked(
    park, serve, open_page, wait_until
):
    server = serve(park)
    port = server.listener.getsockname()[1]
    page = open_page(server.url)
    wait_for_text(page, '#bar-sentence', 'walking to the sun')
    server.close()
    wait_for_text(page, '#bar-word', 'No data')
    assert re.search(r'since \d\d:\d\d:\d\d', text(page, '#bar-sentence'))
    assert page.get_attribute('body', 'data-colour') == 'red'
    assert page.locator('body[data-stale]').count() == 1
    page.keyboard.press('Escape')
    wait_for_text(page, '.stop-note', 'The server does not answer')
    assert park.asked == []
    park.tell_all(sentence='walking on after all')
    serve(park, port=port)
    wait_for_text(page, '#bar-sentence', 'walking on after all')
    assert page.get_attribute('body', 'data-colour') == 'green'
    page.locator('#stop[data-state=ready]').wait_for()
    wait_until(lambda: {asked[:2] for asked in park.asked} == STOPPED, 20.0)


def test_the_chosen_robot_stays_chosen_though_the_next_server_has_yet_to_meet_it(
    make_park, serve, open_page, wait_until
):
    park = make_park('elm', 'oak')
    park.tell_all()
    server = serve(park)
    port = server.listener.getsockname()[1]
    page = open_page(server.url)
    page.locator('[data-robot=oak]').click()
    server.close()
    later = make_park()
    serve(later, port=port)
    page.locator('[data-robot]').first.wait_for(state='detached')
    later.robots = ('elm', 'oak')
    later.tell_all()
    page.locator('[data-robot=oak][aria-checked=true]').wait_for()
    page.locator('[data-act=pause]').click()
    wait_until(lambda: later.asked, 20.0)
    assert {robot for robot, *_ in later.asked} == {'oak'}


def test_release_asks_first_and_stop_can_be_pressed_meanwhile(park, serve, open_page, wait_until):
    park.tell_all(stopped=True, standstill=True)
    page = open_page(serve(park).url)
    page.click('#stop-release')
    question = page.locator('dialog')
    assert 'Release STOP?' in question.inner_text()
    page.click('#stop-button', trial=True)
    question.get_by_text('Cancel').click()
    assert 'release' not in [action for _, action, _ in park.asked]
    page.click('#stop-release')
    page.locator('dialog .primary').click()
    wait_for_text(page, '#outcomes', 'Release')
    wait_until(lambda: 'release' in [action for _, action, _ in park.asked], 20.0)


def test_refusal_of_a_goal_is_shown_in_the_words_of_the_robot(park, serve, open_page):
    from agv_motion.dashboard.server.fleet import RefusedError

    park.answer = RefusedError('(3.00, 2.00) is outside the zone')
    page = open_page(serve(park).url)
    wait_for_text(page, '#bar-sentence', 'walking to the sun')
    page.locator('#map-canvas').click(position={'x': 400, 'y': 100})
    page.locator('#map-question .primary').click()
    wait_for_text(page, '#outcomes', '(3.00, 2.00) is outside the zone')
    assert [action for _, action, _ in park.asked] == ['goal']


def test_a_hand_whose_machine_has_slept_is_told_that_its_commands_are_refused(
    park, serve, open_page, wait_until
):
    page = open_page(serve(park).url)
    page.click('[data-act=drive]')
    page.wait_for_selector('.drive-state:text("hold to drive")')
    page.focus('.drive-surface')
    page.keyboard.down('Space')
    page.keyboard.down('ArrowUp')
    wait_until(lambda: any(twist.vx > 0.0 for _, twist, _ in park.driven))
    page.evaluate("""() => {
      const awake = performance.now.bind(performance);
      performance.now = () => awake() - 5000;
    }""")
    page.wait_for_selector('.drive-state:text("s late and are refused")')
    page.keyboard.up('Space')
    page.click('#drive-close')


def test_a_rest_that_was_asked_for_can_be_ended_early(park, serve, open_page, wait_until):
    page = open_page(serve(park).url)
    page.locator('[data-act=rest]').wait_for()
    assert page.locator('[data-act=end_rest]').count() == 0
    park.sum_up('oak', word='resting', rest_asked=True)
    page.click('[data-act=end_rest]')
    wait_until(lambda: park.asked, 20.0)
    robot, action, told = park.asked[0]
    assert (robot, action, told['values']) == ('oak', 'set_parameters', {'rest_until': 0.0})
    park.sum_up('oak')
    page.locator('[data-act=end_rest]').wait_for(state='detached')


def test_two_tabs_agree_since_both_show_what_robots_report(park, serve, open_page):
    url = serve(park).url
    first, second = open_page(url), open_page(url, PHONE)
    first.click('#stop-button')
    park.tell_all(stopped=True, standstill=True, moving=False)
    for page in (first, second):
        wait_for_text(page, '.stop-label', 'STOPPED')


def test_public_view_has_no_controls_and_speaks_french(park, serve, open_page):
    url = serve(park).url
    page = open_page(f'{url}/public?lang=fr')
    wait_for_text(page, '#public-robots', 'marche')
    assert page.locator('button, input, select, form, [role=button]').count() == 0
    assert page.get_attribute('html', 'lang') == 'fr'
    assert 'comme en 3.2' in text(page, '#public-robots')
    assert 'a bu 12.3\u202fL aujourd\u2019hui (3.8 à 39.4)' in text(page, '#public-robots')
    page.click('#other-language')
    wait_for_text(page, '#public-robots', 'walking')
    page.keyboard.press('Escape')
    page.locator('#map-canvas').click(position={'x': 300, 'y': 200})
    assert park.asked == []
