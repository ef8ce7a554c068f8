import { newKey } from './actions.js';
import { confirm } from './confirm.js';
import { element, write } from '../words/element.js';
import { phrase } from '../words/phrases.js';

/** [ms] between two tries while the server does not answer */
const TRY_AGAIN = 300;
/** [ms] a try without an answer is given up: the line may be dead without a word */
const PATIENCE = 1500;
/** after which the server means it */
const MOST_REFUSALS = 10;
/** [s] a report older than this tells nothing of now */
const FRESH = 2;

/**
 * STOP of all robots, by the button or Escape.
 *
 * It is latched in the robots. What stands on the button is what the robots report: `stopping` until
 * the measured speed of all wheels is zero, then `STOPPED`. A click that does not reach the server is
 * tried until it does.
 */
export class Stop {
  /**
   * @param {import('../live/screen.js').Screen} screen
   * @param {import('./actions.js').Actions} actions
   * @param {HTMLElement} where
   */
  constructor(screen, actions, where) {
    this.screen = screen;
    this.actions = actions;
    this.where = where;
    /** whether a press is on its way, and whether it is to be seen that somebody pressed */
    this.sending = this.asked = false;
    this.timer = 0;
    this.trouble = '';
    this.label = element('span.stop-label', { text: phrase('stopAll') });
    this.note = element('span.stop-note', { id: 'stop-note' });
    this.button = element('button.stop-button', {
      id: 'stop-button', type: 'button', 'aria-keyshortcuts': 'Escape', onclick: () => this.stop(),
    }, this.label, this.note);
    this.release = element('button.stop-release', {
      id: 'stop-release', type: 'button', text: phrase('release'), hidden: true,
      onclick: () => this._release(),
    });
    window.addEventListener('keydown', (event) => {
      if (event.key === 'Escape' && !event.repeat && this.button.isConnected) this.stop();
    }, { capture: true });
  }

  /** Stop all robots: at once, without a question. */
  async stop() {
    if (this.sending || !this.button.isConnected) return;
    this.asked = this.sending = true;
    window.clearTimeout(this.timer);
    this.trouble = '';
    this.draw();
    let refused = 0;
    for (;;) {
      const answer = await this.actions.post('/stop', {}, newKey(), PATIENCE);
      if (answer.ok) break;
      this.trouble = answer.text;
      this.draw();
      // refused again and again: no right; the first refusal may be of a server just restarted
      refused = answer.status >= 400 && answer.status < 500 ? refused + 1 : 0;
      if (refused >= MOST_REFUSALS) break;
      await new Promise((resolve) => setTimeout(resolve, TRY_AGAIN));
    }
    this.sending = false;
    this.timer = window.setTimeout(() => {
      this.asked = false; // from here on the robots' word counts
      this.draw();
    }, 1000);
  }

  async _release() {
    if (!(await confirm(phrase('releaseQuestion'), phrase('release')))) return;
    await this.actions.act('/release', {}, phrase('act release'));
  }

  /** @returns {Node} what stands in the place of STOP once the right to it has ended */
  _lost() {
    return element('p.stop-lost', { role: 'alert' },
      element('a', { href: '/login', text: phrase('stopLost') }));
  }

  /** @param {import('../live/screen.js').Screen} screen */
  update(screen) {
    const may = ['operator', 'expert'].includes(screen.hello?.role ?? 'public');
    if (may !== this.button.isConnected) {
      if (may) this.where.replaceChildren(this.release, this.button);
      else this.where.replaceChildren(this._lost()); // it was there, and somebody may look for it
    }
    this.draw();
  }

  /** Write what the robots report. */
  draw() {
    const store = this.screen.live;
    const reports = store.robots.map((robot) => ({
      robot, summary: store.value(robot, 'summary'), age: store.age(robot, 'summary'),
    }));
    const stopped = reports.filter((report) => report.summary?.stopped);
    const rolling = reports.filter(
      (report) => !report.summary?.standstill || report.summary.moving || report.age > FRESH || store.silence() > FRESH);
    const all = reports.length > 0 && stopped.length === reports.length;
    let state = 'ready';
    if (all) state = rolling.length ? 'stopping' : 'stopped';
    else if (this.asked) state = 'stopping';
    this.where.dataset.state = state;
    this.release.hidden = !stopped.length;
    write(this.label, phrase(`stop ${state}`));
    let note = phrase('keyEscape');
    if (state === 'stopping') note = rolling.map((report) => report.robot).join(', ');
    if (state === 'ready' && stopped.length) {
      note = phrase('someStopped', { robots: stopped.map((report) => report.robot).join(', ') });
    }
    if (state === 'stopped') note = phrase('untilReleased');
    if (this.trouble && state !== 'stopped') note = this.trouble;
    if (state === 'stopped') this.trouble = '';
    write(this.note, note);
    this.button.setAttribute('aria-label', `${phrase(`stop ${state}`)}. ${note}`);
  }
}
