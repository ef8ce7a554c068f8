"""Pictures of the operator's page with three simulated trees behind it, on every size of screen.

    python launch_scripts/page/screenshots.py --output /tmp/page

Starts `agv demo trees` and the page by itself, and needs Chromium. The best of them is
resource/page.png in the README.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from contextlib import ExitStack
from pathlib import Path

os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
os.environ.setdefault('ROS_DOMAIN_ID', str(1 + os.getpid() % 100))
os.environ.setdefault('FASTDDS_BUILTIN_TRANSPORTS', 'UDPv4')

from page_rig import CHROMIUM, FLAGS, Process, free_port
from playwright.sync_api import sync_playwright

LAPTOP, TABLET, PHONE = (1280, 800), (1024, 768), (390, 844)
SAP = '[data-layer="memory/sap_flow"]'
PICTURES = (
    ('page', LAPTOP, '/', ('summary', SAP, 'summary')),
    ('tablet', TABLET, '/', ()),
    ('phone', PHONE, '/', ()),
    ('why', TABLET, '/', ('[data-drawer=why]',)),
    ('probes', TABLET, '/', ('[data-drawer=probes]',)),
    ('health', TABLET, '/', ('[data-drawer=health]',)),
    ('parameters', TABLET, '/', ('[data-drawer=parameters]',)),
    ('zone', TABLET, '/', ('[data-drawer=zone]', '#zone-edit')),
    ('log', TABLET, '/', ('[data-drawer=log]',)),
    ('look_back', TABLET, '/', ('#look-play',)),
    ('drive', TABLET, '/', ('[data-act=drive]', '#drive-turn')),
    ('drive_phone', PHONE, '/', ('[data-act=drive]',)),
    ('public', TABLET, '/public?lang=fr', ()),
)  # fmt: skip
"""name, size of the screen, address, and what is clicked before"""
STOPPED = 'stopped', TABLET, '/', ('#stop-button',)
"""last, since nothing moves after it"""
SETTLED = 2500
"""[ms] after which a page has drawn what it asked for"""


def main():
    """Take all pictures."""
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('--output', type=Path, required=True, help='folder of the pictures')
    parser.add_argument('--only', nargs='*', default=(), help='names of pictures; all')
    parser.add_argument('--after', type=float, default=60.0, help='seconds that the trees walk')
    parser.add_argument('--dark', action='store_true', help='as at night')
    asked = parser.parse_args()
    if not CHROMIUM:
        sys.exit('chromium is not installed: apt-get install chromium')
    asked.output.mkdir(parents=True, exist_ok=True)
    wanted = [one for one in (*PICTURES, STOPPED) if not asked.only or one[0] in asked.only]
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        port = free_port()
        demo = Process(
            '-m', 'agv_motion.cli.main', 'demo', 'trees', '--minutes', '300', '--time-factor', '10',
            '--output', str(folder / 'demo'), ready='goal',
        )  # fmt: skip
        stack.callback(demo.end)
        page = Process(
            '-m', 'agv_motion.cli.main', 'dashboard', '--port', str(port),
            '--state-folder', str(folder / 'state'), '--bag', str(folder / 'demo' / 'bag'),
            ready='the page is at',
        )  # fmt: skip
        stack.callback(page.end)
        driver = stack.enter_context(sync_playwright())
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        for number, picture in enumerate(wanted):
            wait = SETTLED if number else int(asked.after * 1000)
            take(browser, f'http://127.0.0.1:{port}', picture, asked, wait)
        browser.close()


def take(browser, url, picture, asked, wait):
    """Take one picture, after a while [ms]."""
    name, (width, height), address, clicks = picture
    scheme = 'dark' if asked.dark else 'light'
    context = browser.new_context(
        viewport={'width': width, 'height': height}, color_scheme=scheme, reduced_motion='reduce'
    )
    page = context.new_page()
    page.goto(url + address)
    page.wait_for_timeout(wait)
    for selector in clicks:
        page.click(selector)
        page.wait_for_timeout(400)
    page.mouse.move(width / 2, height - 4)
    page.wait_for_timeout(SETTLED)
    path = asked.output / f'{name}.png'
    page.screenshot(path=path)
    print(f'{path}: {path.stat().st_size / 1000:.0f} kB', flush=True)
    context.close()


if __name__ == '__main__':
    main()
