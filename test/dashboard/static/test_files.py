"""The files of the page as text: phrases in both languages, nothing inline, no markup made."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from agv_motion.dashboard import __file__ as room

STATIC = Path(room).parent / 'static'
SCRIPTS = sorted((STATIC / 'js').rglob('*.js'))
PAGES = sorted(STATIC.glob('*.html'))
ENTRY = re.compile(r"^ {2}(?:'([^']+)'|(\w+)): '(.*)',$", re.MULTILINE)
USED = re.compile(r"phrase\('([^'$]+)'")
IN_PAGE = re.compile(r'data-(?:phrase|label)="([^"]+)"')


def table(language):
    text = (STATIC / 'js' / 'words' / f'{language}.js').read_text('utf-8')
    return {quoted or plain: phrase for quoted, plain, phrase in ENTRY.findall(text)}


def test_both_languages_have_the_same_phrases_with_the_same_places_for_values():
    english, french = table('english'), table('french')
    assert english.keys() == french.keys()
    places = re.compile(r'\{\w+\}')
    for key, words in english.items():
        assert set(places.findall(words)) == set(places.findall(french[key])), key


def test_every_phrase_that_is_used_is_in_the_table():
    scripts = ''.join(path.read_text('utf-8') for path in SCRIPTS)
    pages = ''.join(path.read_text('utf-8') for path in PAGES)
    used = set(USED.findall(scripts)) | set(IN_PAGE.findall(pages))
    assert used - table('english').keys() == set()


@pytest.mark.parametrize('path', PAGES, ids=lambda path: path.name)
def test_pages_have_nothing_inline_and_nothing_from_elsewhere(path):
    text = path.read_text('utf-8')
    assert not re.search(r'\son\w+=|\sstyle=|<style|<script(?![^>]*\ssrc=)', text)
    assert not re.search(r'(?:src|href)="(?!/)', text)


@pytest.mark.parametrize('path', SCRIPTS, ids=lambda path: path.stem)
def test_scripts_make_no_markup_of_text_and_stay_short(path):
    text = path.read_text('utf-8')
    forbidden = r'innerHTML|outerHTML|insertAdjacentHTML|document\.write|\beval\(|new Function'
    assert not re.search(forbidden, text)
    assert not re.search(r'https?://(?!www\.w3\.org/2000/svg)', text)
    assert text.count('\n') <= 250
    for imported in re.findall(r"from '(\.[^']+)'", text):
        assert (path.parent / imported).resolve().is_file(), imported


def needed(script, found):
    """Collect a script and all that it imports, directly or not."""
    if script not in found:
        found.add(script)
        for imported in re.findall(
            r"^(?:import|export)\b[^']*?'(\.[^']+)'", script.read_text('utf-8'), re.MULTILINE
        ):
            needed((script.parent / imported).resolve(), found)
    return found


@pytest.mark.parametrize(('page', 'script'), [('index', 'operator'), ('public', 'public')])
def test_a_page_loads_all_its_scripts_at_once_and_no_other(page, script):
    first = (STATIC / 'js' / f'{script}.js').resolve()
    text = (STATIC / f'{page}.html').read_text('utf-8')
    told = re.findall(r'<link rel="modulepreload" href="/static/([^"]+)">', text)
    assert told == sorted(set(told))
    assert {(STATIC / each).resolve() for each in told} == needed(first, set()) - {first}


def test_style_sheets_load_nothing():
    for path in (STATIC / 'css').glob('*.css'):
        assert not re.search(r'url\(|@import', path.read_text('utf-8')), path.name


def test_public_view_imports_nothing_that_acts():
    seen, waiting = set(), [STATIC / 'js' / 'public.js']
    while waiting:
        path = waiting.pop()
        seen.add(path)
        for imported in re.findall(r"from '(\.[^']+)'", path.read_text('utf-8')):
            found = (path.parent / imported).resolve()
            if found not in seen:
                waiting.append(found)
    assert not {'act', 'drive', 'look_back'} & {path.parent.name for path in seen}
