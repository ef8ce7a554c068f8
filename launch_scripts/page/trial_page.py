"""From a hand on the operator's page to the wheels: STOP, and every way in which a hand is lost.

    python launch_scripts/page/trial_page.py --stops 100 --losses 10

A real Chromium, a real server and a simulated tree of real ROS nodes on this machine. Measured is
from the moment at which the browser saw the hand move (or the tab, the network or the server was
taken away) until the wheels are commanded zero. Exits with 1 where a limit does not hold. Figures
taken while the machine does other things tell of those.
"""

from __future__ import annotations

import argparse
import os
import signal
import sys
import tempfile
import time
from pathlib import Path

os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
os.environ.setdefault('ROS_DOMAIN_ID', str(1 + os.getpid() % 100))
os.environ.setdefault('FASTDDS_BUILTIN_TRANSPORTS', 'UDPv4')
os.environ.setdefault('OPENBLAS_NUM_THREADS', '1')

import numpy as np
from page_rig import CHROMIUM, FLAGS, acted, rig
from playwright.sync_api import sync_playwright

LOAD, STOP, DEAD_MAN = 2.0, 0.2, 0.5
"""[s] limits: of loading, and at the 99th percentile of STOP; of a hand that is lost"""


def load(rig, count):
    """Return how long the page takes until it tells of the robot [s], each time from nothing."""
    times = []
    for _ in range(count):
        with rig.page() as page:
            times.append(page.evaluate('performance.now() / 1000'))
    return times


def stops(rig, count):
    """Return how long STOP takes, by click and by key in turn [s]."""
    times = []
    rig.wheels.walking = True
    with rig.page() as page:
        for number in range(count):
            rig.wheels.wait(rig.wheels.rolls)
            if number % 2:
                page.keyboard.press('Escape')
            else:
                page.click('#stop-button')
            times.append(rig.wheels.stood_after(acted(page)))
            page.locator('#stop[data-state=stopped]').wait_for()
            page.click('#stop-release')
            page.locator('dialog .primary').click()
            page.locator('#stop[data-state=ready]').wait_for()
    rig.wheels.walking = False
    rig.wheels.stood_after(time.time())
    return times


def let_go(rig, page):
    """Let the stick go; return when."""
    del rig
    page.mouse.up()
    return acted(page)


def close(rig, page):
    """Close the tab; return when."""
    del rig
    moment = time.time()
    page.close()
    return moment


def cut(rig, page):
    """Cut the network; return when."""
    del page
    rig.cable.cut()
    return time.time()


def kill(rig, page):
    """Kill the server; return when."""
    del page
    moment = time.time()
    rig.server.end(signal.SIGKILL)
    return moment


def losses(rig, lose, count):
    """Return how long the wheels roll on when the hand is lost [s]."""
    times = []
    for _ in range(count):
        with rig.page() as page:
            rig.open_drive(page)
            rig.press(page)
            times.append(rig.wheels.stood_after(lose(rig, page)))
        if lose is cut:
            rig.cable.mend()
        if lose is kill:
            rig.serve()
    return times


def told(name, times, limit, share=100.0):
    """Print what was measured; return whether the limit holds."""
    if not times:
        return True
    middle, high = np.percentile(times, [50.0, share]) * 1000.0
    verdict = 'holds' if high <= limit * 1000.0 else 'DOES NOT HOLD'
    print(
        f'{name:24} {len(times):4} times, median {middle:6.0f} ms, {share:g} % {high:6.0f} ms, '
        f'limit {limit * 1000:.0f} ms: {verdict}', flush=True,
    )  # fmt: skip
    return high <= limit * 1000.0


def main():
    """Run all trials."""
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('--loads', type=int, default=5, help='times the page is loaded')
    parser.add_argument('--stops', type=int, default=100, help='times STOP is pressed')
    parser.add_argument('--losses', type=int, default=5, help='times the hand is lost, each way')
    asked = parser.parse_args()
    if not CHROMIUM:
        sys.exit('chromium is not installed: apt-get install chromium')
    with sync_playwright() as driver, tempfile.TemporaryDirectory() as folder:
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        with rig(browser, Path(folder)) as found:
            holds = [
                told('page loaded', load(found, asked.loads), LOAD),
                told('STOP', stops(found, asked.stops), STOP, 99.0),
                *(
                    told(name, losses(found, lose, asked.losses), DEAD_MAN)
                    for name, lose in (
                        ('stick let go', let_go), ('tab closed', close), ('network cut', cut),
                        ('server killed', kill),
                    )
                ),
            ]  # fmt: skip
        browser.close()
    sys.exit(not all(holds))


if __name__ == '__main__':
    main()
