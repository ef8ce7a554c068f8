"""Which bags lie in a folder, and whether one has changed."""

from __future__ import annotations

import os

from agv_motion.bag.catalog.discovery import bags_below, signature, size


def test_links_that_lead_back_end(season):
    (season / 'north' / 'up').symlink_to(season, target_is_directory=True)
    assert len(set(bags_below(season))) == 4


def test_bags_behind_links_count_and_hidden_or_other_files_do_not(season, tmp_path):
    (tmp_path / 'disk').mkdir()
    (season / 'b').rename(tmp_path / 'disk' / 'far')
    (season / 'link').symlink_to(tmp_path / 'disk', target_is_directory=True)
    for name in ('.loose.mcap', 'words.txt', '.words'):
        (season / name).touch()
    found = [str(path.relative_to(season)) for path in bags_below(season)]
    assert found == ['loose.mcap', 'c', 'link/far', 'north/a']


def test_a_signature_changes_with_the_files(season):
    before = signature(season / 'b')
    assert signature(season / 'b') == before
    (season / 'b' / 'notes.jsonl').write_text('x')
    marks = [before, signature(season / 'b')]
    for file, bag in ((season / 'b' / 'b_0.mcap', season / 'b'), (season / 'loose.mcap',) * 2):
        marks.append(signature(bag))
        os.utime(file, ns=(1, 1))
        marks.append(signature(bag))
    assert len(set(marks)) == 5  # that of b with notes is there twice


def test_the_size_is_that_of_all_files(tmp_path):
    (tmp_path / 'bag' / 'inner').mkdir(parents=True)
    for name, length in (('a.mcap', 7), ('metadata.yaml', 5), ('inner/b', 3)):
        (tmp_path / 'bag' / name).write_bytes(bytes(length))
    assert (size(tmp_path / 'bag'), size(tmp_path / 'bag' / 'a.mcap')) == (12, 7)
