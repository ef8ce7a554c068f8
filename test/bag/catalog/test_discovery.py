"""Which bags lie in a folder, and whether one has changed."""

from __future__ import annotations

from agv_motion.bag.catalog.discovery import bags_below, signature


def test_links_that_lead_back_end(season):
    (season / 'north' / 'up').symlink_to(season, target_is_directory=True)
    assert len(set(bags_below(season))) == 4


def test_a_signature_changes_with_the_files(season):
    before = signature(season / 'b')
    assert signature(season / 'b') == before
    (season / 'b' / 'notes.jsonl').write_text('x')
    assert signature(season / 'b') != before
