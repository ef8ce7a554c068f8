import { Hours } from './hours.js';
import { element, refill, write } from '../words/element.js';
import { number } from '../words/format.js';
import { phrase } from '../words/phrases.js';

/** Zone and hours: corners by drag on the map and by numbers; the robot has the last word. */
export class ZoneDrawer {
  /**
   * @param {import('../live/screen.js').Screen} screen
   * @param {import('../act/actions.js').Actions} actions
   * @param {import('../map/operator_map.js').OperatorMap} map
   */
  constructor(screen, actions, map) {
    this.screen = screen;
    this.actions = actions;
    this.map = map;
    /** @type {any} the zone that is being edited */
    this.draft = null;
    this.robot = '';
    /** id of the last zone that was sent: its outcome is told here too */
    this.sent = '';
    this.text = element('p');
    this.numbers = element('div.corners');
    this.buttons = element('div.buttons');
    this.refusal = element('p.refusal', { role: 'alert' });
    this.hours = new Hours(screen, actions);
    this.body = element('div.columns', {},
      element('section', {}, element('h3', { text: phrase('zone') }), this.text, this.buttons, this.refusal, this.numbers),
      element('section', {}, element('h3', { text: phrase('hours') }), this.hours.form));
    screen.outcomes.push((outcome) => {
      if (outcome.id !== this.sent) return;
      write(this.refusal, outcome.state === 'refused' || outcome.state === 'no_answer' ? outcome.text : '');
      if (outcome.state === 'done') this._end();
    });
  }

  open() {
    this.hours.open();
  }

  close() {
    this.hours.close();
    this._end();
  }

  /** @param {import('../live/screen.js').Screen} screen */
  update(screen) {
    const may = screen.hello?.role === 'expert' && !screen.past;
    if (this.draft && (this.map.mode !== this.mode || !may || this.robot !== screen.chosen)) this._end();
    const zone = this.draft ?? screen.store.ownOrShared(screen.chosen, 'zone');
    write(this.text, zone ? phrase('zoneText', {
      corners: String(zone.boundary.length), area: number(area(zone), 0, 'm²'),
      holes: String(zone.holes.length), margin: number(zone.margin, 2, 'm'),
    }) : phrase('noZone'));
    this.hours.update(screen, may);
    refill(this.buttons, JSON.stringify([may, Boolean(this.draft), Boolean(zone)]), () => this._buttons(may, zone));
    if (!this.numbers.contains(document.activeElement)) {
      refill(this.numbers, JSON.stringify(this.draft), () => (this.draft ? this._corners(this.draft) : []));
    }
  }

  /** @param {boolean} may @param {any} zone */
  _buttons(may, zone) {
    if (!may || !zone) return [];
    if (!this.draft) {
      return [element('button', { type: 'button', id: 'zone-edit', text: phrase('edit'), onclick: () => this._begin() })];
    }
    return [
      element('button', { type: 'button', text: phrase('cancel'), onclick: () => this._end() }),
      element('button.primary', { type: 'button', id: 'zone-send', text: phrase('putInForce'), onclick: () => this._send() }),
    ];
  }

  _begin() {
    write(this.refusal, '');
    this.robot = this.screen.chosen; // whose zone it is: another chosen meanwhile ends the draft
    this.draft = structuredClone(this.screen.store.ownOrShared(this.robot, 'zone'));
    this.mode = this.map.begin('zone', { zone: this.draft, changed: () => this.screen.redraw('drawer') });
    if (!this.mode) this.draft = null;
    this.screen.redraw('drawer');
  }

  _end() {
    if (this.draft && this.map.mode === this.mode) this.map.end();
    this.draft = null;
    this.screen.redraw('drawer');
  }

  async _send() {
    const { store, chosen, robots } = this.screen;
    const told = robots.map((robot) => store.ownOrShared(robot, 'zone')).filter(Boolean);
    // robots that share a zone go on sharing it
    const shared = told.every((zone) => JSON.stringify(zone) === JSON.stringify(told[0]));
    const answer = await this.actions.act('/zone',
      { ...(shared ? {} : { robot: chosen }), zone: this.draft }, phrase('zone'));
    this.sent = answer.body?.id ?? '';
    if (!answer.ok) write(this.refusal, answer.text);
  }

  /** @param {any} draft */
  _corners(draft) {
    const groups = [
      [phrase('boundary'), draft.boundary],
      ...draft.holes.map((/** @type {any} */ hole, /** @type {number} */ index) => [`${phrase('hole')} ${index + 1}`, hole]),
      ...draft.translation_only.map((/** @type {any} */ part, /** @type {number} */ index) => [`${phrase('noTurning')} ${index + 1}`, part]),
    ];
    return groups.map(([title, corners]) => element('fieldset', {}, element('legend', { text: title }),
      ...corners.map((/** @type {number[]} */ corner, /** @type {number} */ index) => element('div.corner', {},
        ...[0, 1].map((axis) => this._number(`${title} ${index + 1} ${'xy'[axis]}`, 'xy'[axis], corner, axis)),
        element('button.small', {
          type: 'button', text: '+', 'aria-label': `${phrase('addCorner')} ${title} ${index + 1}`,
          onclick: () => this._add(corners, index),
        }),
        corners.length > 3 ? element('button.small', {
          type: 'button', text: '−', 'aria-label': `${phrase('removeCorner')} ${title} ${index + 1}`,
          onclick: () => {
            corners.splice(index, 1);
            this._changed();
          },
        }) : null))));
  }

  /** A new corner half way to the next. */
  _add(/** @type {number[][]} */ corners, /** @type {number} */ index) {
    const [here, next] = [corners[index], corners[(index + 1) % corners.length]];
    corners.splice(index + 1, 0, [(here[0] + next[0]) / 2, (here[1] + next[1]) / 2]);
    this._changed();
  }

  _changed() {
    /** @type {HTMLElement|null} */ (document.activeElement)?.blur();
    this.screen.redraw('drawer');
  }

  /** @param {string} label @param {string} name @param {number[]} corner @param {number} axis */
  _number(label, name, corner, axis) {
    const field = element('input', { type: 'number', step: '0.05', value: corner[axis].toFixed(2), 'aria-label': label });
    field.addEventListener('change', () => {
      if (Number.isFinite(field.valueAsNumber)) corner[axis] = field.valueAsNumber;
      this.screen.redraw('look');
    });
    return element('label', {}, element('span', { text: name }), field);
  }
}

/** @returns {number} [m2] of the floor, holes left out */
function area(/** @type {import('../live/types.js').Zone} */ zone) {
  const of = (/** @type {[number, number][]} */ polygon) => Math.abs(polygon.reduce((sum, [x, y], index) => {
    const [nextX, nextY] = polygon[(index + 1) % polygon.length];
    return sum + (x * nextY - nextX * y) / 2;
  }, 0));
  return of(zone.boundary) - zone.holes.reduce((sum, hole) => sum + of(hole), 0);
}
