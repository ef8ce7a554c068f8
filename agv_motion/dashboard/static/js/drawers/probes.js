import { Chart } from './chart.js';
import { element, refill, write } from '../words/element.js';
import { hourMinute, inLitres, number } from '../words/format.js';
import { phrase } from '../words/phrases.js';

const SIGNALS = ['s1', 's2', 's3'];
const COLOURS = { s1: '--series-1', s2: '--series-2', s3: '--series-3' };

/** The probes and what they can be believed, the signals made of them, and the day as charts. */
export class ProbesDrawer {
  /** @param {import('../live/screen.js').Screen} screen */
  constructor(screen) {
    this.screen = screen;
    this.probes = element('div.cards');
    this.signals = element('div.meters');
    this.drank = element('p.drank');
    this.signalChart = new Chart(phrase('sapFlow'));
    this.body = element('div.probes', {},
      element('section', {}, element('h3', { text: phrase('probes') }), this.probes,
        element('h3', { text: phrase('signals') }), this.signals),
      element('section', {},
        element('h3', { text: phrase('dayOfSapFlow') }), this.signalChart.canvas,
        this.drank));
  }

  /** @param {import('../live/screen.js').Screen} screen @param {Set<string>} changed */
  update({ store, chosen }, changed) {
    const probes = store.value(chosen, 'probes')?.probes ?? [];
    refill(this.probes, JSON.stringify([chosen, probes]), () => (probes.length
      ? probes.map((/** @type {any} */ probe) => element('article.card.probe', { 'data-quality': probe.quality },
        element('span.probe-name', { text: probe.name }),
        element('span.probe-quality', { text: probe.quality }),
        element('span.probe-value', { text: number(probe.temperature_difference, 3, 'K') }),
        element('span.probe-signal', { text: number(probe.signal, 2) }),
        element('span.probe-text', { text: probe.text ?? '' })))
      : [element('p.empty', { text: phrase('noProbes') })]));
    this._drawSignals(store.value(chosen, 'sap_flow'));
    write(this.drank, drankToday(store.value(chosen, 'drank')));
    const day = store.value(chosen, 'day');
    if (day !== this.day || changed.has('drawer')) {
      this.day = day;
      this._drawDay(day ?? {}); // one that tells none does not keep that of another
    }
  }

  /** @param {any} sapFlow */
  _drawSignals(sapFlow) {
    const values = sapFlow?.s ?? [null, null, null];
    refill(this.signals, String(Boolean(sapFlow)), () => (sapFlow ? SIGNALS.map((signal) =>
      element('div.meter', {}, element('span.meter-name', { text: `${signal} · ${phrase(`meaning ${signal}`)}` }),
        element('meter', { min: '0', max: '1', 'aria-label': signal }), element('output'))) : []));
    this.signals.toggleAttribute('data-invalid', sapFlow?.valid === false);
    SIGNALS.forEach((_, index) => {
      const row = this.signals.children[index];
      if (!row) return;
      row.children[1].value = values[index] ?? 0;
      write(row.children[2], number(values[index], 2));
    });
  }

  /** @param {any} day */
  _drawDay(day) {
    const times = day.times ?? [];
    this.signalChart.show({
      times, unit: '', low: 0, high: 1, time: hourMinute,
      lines: SIGNALS.filter((signal) => day[signal]).map((signal) => ({
        name: signal, colour: COLOURS[/** @type {keyof COLOURS} */ (signal)], values: day[signal],
      })),
    });
  }
}

/** @returns {string} what it drank today: litres, or else hours at full flow; empty: not told */
export function drankToday(/** @type {import('../live/types.js').Drank|null} */ drank) {
  if (drank?.litres) return phrase('drankLitres', inLitres(drank.litres));
  if (typeof drank?.hours !== 'number') return '';
  return phrase('drankToday', { hours: number(drank.hours, 1, 'h') });
}
