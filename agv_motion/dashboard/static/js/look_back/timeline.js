import { confirm } from '../act/confirm.js';
import { byId, element, refill, write } from '../words/element.js';
import { clockTime, dateTime } from '../words/format.js';
import { icon } from '../words/icon.js';
import { phrase } from '../words/phrases.js';

const DAY = 86400;
/** seconds of the recording per second */
const RATES = [1, 10, 60, 600];
/** [ms] a slider that moves asks for a new moment at most so often */
const CALM = 150;
/** [s] kept before and after a moment that is saved */
const AROUND = 300;

/**
 * The slider over the recorded day: jump, play, and back to now. Alerts and marks are its ticks.
 */
export class Timeline {
  /**
   * @param {import('../live/screen.js').Screen} screen
   * @param {import('../act/actions.js').Actions} actions
   * @param {HTMLElement} where
   */
  constructor(screen, actions, where) {
    this.screen = screen;
    this.actions = actions;
    this.where = where;
    this.playing = false;
    this.timer = 0;
    const button = (/** @type {string} */ id, /** @type {() => void} */ onclick) =>
      element('button', { type: 'button', id: `look-${id}`, title: phrase(`look ${id}`), 'aria-label': phrase(`look ${id}`), onclick }, icon(/** @type {any} */ (id)));
    this.slider = element('input', {
      type: 'range', id: 'look-slider', min: '0', max: '1', step: '1', value: '1', 'aria-label': phrase('lookBack'),
    });
    this.slider.addEventListener('input', () => this._jumpSoon(Number(this.slider.value)));
    this.rate = element('select', { id: 'look-rate', 'aria-label': phrase('look rate') },
      ...RATES.map((rate) => element('option', { value: rate, text: `×${rate}`, selected: rate === 10 })));
    this.rate.addEventListener('change', () => this.playing && this._jump(this.shown));
    this.ticks = element('div.ticks', { 'aria-hidden': 'true' });
    this.begin = element('span.look-end');
    this.play = button('play', () => this._play());
    this.now = element('button.look-now', { type: 'button', id: 'look-now', text: phrase('now'), onclick: () => this.screen.lookAtNow() });
    this.save = button('save', () => this._save());
    this.mark = element('button.look-mark', { type: 'button', id: 'look-mark', text: phrase('mark'), onclick: () => this._mark() });
    where.append(this.now, button('before', () => this._step(-1)), this.play, this.rate, button('after', () => this._step(1)),
      element('div.look-slider', {}, this.ticks, this.slider, this.begin), this.save, this.mark);
  }

  /** @returns {{begin: number, end: number}|null} */
  get span() {
    const told = this.screen.live.value('', 'history');
    const end = Math.max(told?.end ?? 0, told?.begin ?? 0);
    if (!told || !(end > told.begin)) return null;
    return { begin: Math.max(told.begin, end - DAY), end };
  }

  /** @returns {{at: number, kind: string}[]} alerts and marks within the span, in order */
  get events() {
    const { live } = this.screen;
    const alerts = (live.value('', 'alerts') ?? []).map((/** @type {any} */ alert) => ({ at: alert.raised, kind: String(alert.level).toLowerCase() }));
    const marks = (live.value('', 'marks') ?? []).map((/** @type {any} */ mark) => ({ at: mark.at, kind: 'mark' }));
    const { span } = this;
    return [...alerts, ...marks].filter(({ at }) => span && at >= span.begin && at <= span.end).sort((a, b) => a.at - b.at);
  }

  /** @param {import('../live/screen.js').Screen} screen */
  update(screen) {
    const { span } = this;
    const past = Boolean(screen.past);
    if (!past) this.playing = false;
    const may = ['operator', 'expert'].includes(screen.hello?.role ?? 'public');
    this.mark.hidden = this.save.hidden = !may;
    for (const part of this.where.querySelectorAll('button, input, select')) {
      if (part !== this.mark) part.disabled = !span;
    }
    this.now.disabled = !past;
    document.body.toggleAttribute('data-past', past);
    const banner = byId('past-banner');
    banner.hidden = !past;
    if (past) write(banner, phrase('pastBanner', { time: dateTime(screen.store.heard === null ? Number(this.slider.value) : screen.store.now()) }));
    refill(this.play, String(this.playing), () => [icon(this.playing ? 'pause' : 'play')]);
    if (!span) write(this.begin, phrase('noRecording'));
    if (!span) return;
    this.slider.min = String(Math.floor(span.begin));
    this.slider.max = String(Math.ceil(span.end));
    const at = past ? Math.min(screen.store.heard === null ? Number(this.slider.value) : screen.store.now(), span.end) : span.end;
    if (document.activeElement !== this.slider || this.playing || !past) this.slider.value = String(Math.round(at));
    this.slider.setAttribute('aria-valuetext', past ? dateTime(at) : phrase('now'));
    write(this.begin, clockTime(span.begin));
    const { events } = this;
    refill(this.ticks, JSON.stringify([Math.floor(span.begin / 60), Math.floor(span.end / 60), events]), () => events.map(({ at: when, kind }) => {
      const tick = element('span.tick', { 'data-kind': kind });
      tick.style.setProperty('--at', String((when - span.begin) / (span.end - span.begin)));
      return tick;
    }));
  }

  /** @param {number} at */
  _jumpSoon(at) {
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this._jump(at), CALM);
  }

  /** @param {number} at */
  _jump(at) {
    this.screen.lookBack(at, this.playing ? Number(this.rate.value) : 0);
  }

  /** @returns {number} what is shown now, or the end */
  get shown() {
    const { past } = this.screen;
    return past ? (past.heard === null ? Number(this.slider.value) : past.now()) : this.span?.end ?? 0;
  }

  _play() {
    this.playing = !this.playing;
    this._jump(this.screen.past ? this.shown : (this.span?.begin ?? 0));
  }

  /** To the alert or mark before or after. @param {number} direction */
  _step(direction) {
    const here = this.shown;
    const events = direction < 0 ? [...this.events].reverse() : this.events;
    const next = events.find(({ at }) => direction * (at - here) > 1);
    if (next) this._jump(next.at);
    else if (direction > 0) this.screen.lookAtNow();
    else if (this.span) this._jump(this.span.begin);
  }

  async _save() {
    const middle = this.shown;
    await this.actions.act('/history/save', { begin: middle - AROUND, end: middle + AROUND }, phrase('look save'));
  }

  async _mark() {
    const field = element('input', { id: 'mark-text', maxlength: '200' });
    const label = element('label.field', { for: 'mark-text' }, element('span', { text: phrase('markText') }), field);
    if (await confirm(phrase('markQuestion'), phrase('mark'), [label])) {
      await this.actions.act('/mark', { text: field.value }, phrase('mark'));
    }
  }
}
