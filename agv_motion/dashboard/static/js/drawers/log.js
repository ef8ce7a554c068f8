import { element, refill } from '../words/element.js';
import { dateTime } from '../words/format.js';
import { phrase } from '../words/phrases.js';

/** Alerts with their history, and the marks. */
export class LogDrawer {
  /**
   * @param {import('../live/screen.js').Screen} screen
   * @param {import('../act/actions.js').Actions} actions
   */
  constructor(screen, actions) {
    this.screen = screen;
    this.actions = actions;
    this.alerts = element('ul.log');
    this.marks = element('ul.log');
    this.body = element('div.columns', {},
      element('section', {}, element('h3', { text: phrase('alerts') }), this.alerts),
      element('section', {}, element('h3', { text: phrase('marks') }), this.marks));
  }

  /** @param {import('../live/screen.js').Screen} screen */
  update({ live, hello, past }) {
    const may = ['operator', 'expert'].includes(hello?.role ?? 'public') && !past;
    const alerts = [...(live.value('', 'alerts') ?? [])].sort((a, b) => b.raised - a.raised);
    refill(this.alerts, JSON.stringify([alerts, may]), () => (alerts.length
      ? alerts.map((alert) => this._alert(alert, may)) : [element('li.empty', { text: phrase('noAlerts') })]));
    const marks = [...(live.value('', 'marks') ?? [])].sort((a, b) => b.at - a.at);
    refill(this.marks, JSON.stringify(marks), () => (marks.length
      ? marks.map((mark) => this._mark(mark)) : [element('li.empty', { text: phrase('noMarks') })]));
  }

  /** @param {any} alert @param {boolean} may */
  _alert(alert, may) {
    const state = alert.cleared ? phrase('cleared', { time: dateTime(alert.cleared) }) : phrase('stillRaised');
    const seen = alert.acknowledged ? phrase('acknowledged', { by: alert.by ?? '' }) : '';
    return element('li.entry', { 'data-level': String(alert.level).toLowerCase(), 'data-open': !alert.cleared },
      element('span.entry-time', { text: dateTime(alert.raised) }),
      element('span.entry-robot', { text: alert.robot }),
      element('p.entry-text', { text: alert.sentence }),
      element('p.entry-state', { text: [state, seen].filter(Boolean).join(' · ') }),
      element('span.entry-buttons', {},
        element('button.small', {
          type: 'button', text: phrase('look'), 'aria-label': `${phrase('look')}: ${alert.sentence}`,
          onclick: () => this.screen.lookBack(alert.raised, 1),
        }),
        may && !alert.acknowledged ? element('button.small', {
          type: 'button', text: phrase('acknowledge'), 'aria-label': `${phrase('acknowledge')}: ${alert.sentence}`,
          onclick: () => this.actions.act(
            `/alerts/${encodeURIComponent(alert.id)}/acknowledge`, {}, phrase('acknowledge')),
        }) : null));
  }

  /** @param {any} mark */
  _mark(mark) {
    return element('li.entry', {},
      element('span.entry-time', { text: dateTime(mark.at) }),
      element('span.entry-robot', { text: mark.by ?? '' }),
      element('p.entry-text', { text: mark.text }),
      element('span.entry-buttons', {}, element('button.small', {
        type: 'button', text: phrase('look'), 'aria-label': `${phrase('look')}: ${mark.text}`,
        onclick: () => this.screen.lookBack(mark.at, 1),
      })));
  }
}
