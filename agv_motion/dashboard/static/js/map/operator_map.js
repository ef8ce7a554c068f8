import { rim } from './body.js';
import { Gestures } from './gestures.js';
import { RAMPS } from './heat.js';
import { drawCross } from './handle.js';
import { WorldMap } from './map.js';
import { PlaceRobot } from './place_robot.js';
import { TurnAbout } from './turn_about.js';
import { ZoneEdit } from './zone_edit.js';
import { byId, element, refill } from '../words/element.js';
import { number } from '../words/format.js';
import { icon } from '../words/icon.js';
import { phrase } from '../words/phrases.js';

const LAYERS = ['trail', 'reservations', 'light', 'memory/sap_flow', 'memory/last_visit'];

/** The map with hands: tools, layers, a goal by a click, and the modes that take the map over. */
export class OperatorMap extends WorldMap {
  /**
   * @param {import('../live/screen.js').Screen} screen
   * @param {import('../act/actions.js').Actions} actions
   */
  constructor(screen, actions) {
    super(screen, byId('map-canvas'));
    this.actions = actions;
    this.question = byId('map-question');
    /** @type {any} what has taken the map over: placing a robot, turning, editing the zone */
    this.mode = null;
    /** @type {[number, number]|null} place of a goal that is asked about [m] */
    this.asked = null;
    this.gestures = new Gestures(this.canvas, this.view, {
      grab: (column, row) => this.mode?.grab?.(column, row) ?? null,
      click: (column, row) => this._click(column, row),
      key: (event) => this._key(event),
      moved: () => {
        this.view.touched = true;
        this.screen.redraw('look');
      },
      fit: () => this.fit(),
    });
    this.above.push((scene) => this._drawAbove(scene));
    this._makeTools();
  }

  /** @param {import('../live/screen.js').Screen} screen */
  update(screen) {
    super.update(screen);
    refill(byId('map-legend'), `${[...this.layers].join()}`, () => this._legend());
    if (screen.past) this.end();
  }

  /** @returns {boolean} whether this person may act, now */
  get mayAct() {
    const role = this.screen.hello?.role ?? 'public';
    return ['operator', 'expert'].includes(role) && !this.screen.past;
  }

  /**
   * Let something take the map over.
   * @param {'pose'|'turn'|'zone'} kind
   * @param {any} given
   * @returns {any} the mode, or null if this person may not
   */
  begin(kind, given = null) {
    this.end();
    if (!this.mayAct) return null;
    const Mode = { pose: PlaceRobot, turn: TurnAbout, zone: ZoneEdit }[kind];
    this.mode = new Mode(this, given);
    this.canvas.focus({ preventScroll: true });
    this.screen.redraw('look');
    return this.mode;
  }

  /** Give the map back. */
  end() {
    this.asked = null;
    this.question.replaceChildren();
    const mode = this.mode;
    this.mode = null;
    mode?.end?.();
    this.screen.redraw('look');
  }

  /** @param {...(Node|string)} parts of a question that is asked on the map */
  ask(...parts) {
    this.question.replaceChildren(element('div.map-ask', { role: 'group' }, ...parts));
  }

  _makeTools() {
    const tool = (/** @type {string} */ key, /** @type {any} */ sign, /** @type {() => void} */ act) =>
      element('button.tool', { type: 'button', 'aria-label': phrase(key), title: phrase(key), onclick: act }, icon(sign));
    const zoom = (/** @type {number} */ factor) => {
      this.view.zoomAt(factor, this.view.width / 2, this.view.height / 2);
      this.view.touched = true;
      this.screen.redraw('look');
    };
    const layers = element('details.layers', {},
      element('summary.tool', { 'aria-label': phrase('layers'), title: phrase('layers') }, icon('layers')),
      element('div.layer-list', {}, ...LAYERS.map((layer) => this._layerBox(layer))));
    byId('map-tools').append(
      tool('zoomIn', 'plus', () => zoom(1.4)), tool('zoomOut', 'minus', () => zoom(1 / 1.4)),
      tool('fit', 'fit', () => this.fit()), layers);
  }

  /** @param {string} layer */
  _layerBox(layer) {
    const box = element('input', {
      type: 'checkbox', checked: this.layers.has(layer), 'data-layer': layer,
    });
    box.addEventListener('change', () => {
      if (box.checked) this.layers.add(layer);
      else this.layers.delete(layer);
      if (layer in RAMPS) {
        const slots = this.screen.robots.map((robot) => `${robot}/${layer}`);
        if (box.checked) this.screen.want(slots);
        else this.screen.forget(slots);
      }
      this.screen.redraw('look');
    });
    return element('label.layer', {}, box, element('span', { text: phrase(`layer ${layer}`) }));
  }

  _legend() {
    return Object.keys(RAMPS).filter((topic) => this.layers.has(topic)).map((topic) =>
      element('div.legend', {},
        element('span.legend-title', { text: phrase(`layer ${topic}`) }),
        element('span', { text: phrase(`low ${topic}`) }),
        element('span.legend-ramp', { 'data-ramp': topic, 'aria-hidden': 'true' }),
        element('span', { text: phrase(`high ${topic}`) })));
  }

  /** @param {number} column @param {number} row */
  _click(column, row) {
    if (this.mode) return;
    const robot = this.robotAt(column, row);
    if (robot) {
      this.end();
      this.screen.choose(robot);
    } else {
      this._askGoal(this.view.toWorld(column, row));
    }
  }

  /** @param {[number, number]} place */
  _askGoal(place) {
    const robot = this.screen.chosen;
    if (!this.mayAct || !robot) return;
    this.asked = place;
    const [x, y] = place;
    const send = element('button.primary', {
      type: 'button', text: phrase('send'),
      onclick: () => {
        this.end();
        this.actions.robot(robot, 'goal', { x, y });
      },
    });
    this.ask(
      element('p', { text: phrase('goalQuestion', { robot, x: number(x, 2), y: number(y, 2) }) }),
      element('button', { type: 'button', text: phrase('cancel'), onclick: () => this.end() }), send);
    send.focus({ preventScroll: true });
    this.screen.redraw('look');
  }

  /** @param {KeyboardEvent} event @returns {boolean} whether it was ours */
  _key(event) {
    if (this.mode?.key?.(event)) return true;
    if (event.key !== 'Enter' || this.mode) return false;
    this._askGoal([this.view.x, this.view.y]);
    return true;
  }

  /** @param {import('./map.js').Scene} scene */
  _drawAbove(scene) {
    this.mode?.draw?.(scene);
    if (this.asked) drawCross(scene, this.asked, 'goal');
    const byKeys = document.activeElement === this.canvas && this.canvas.matches(':focus-visible');
    if (byKeys && !this.mode && this.mayAct) drawCross(scene, [this.view.x, this.view.y], 'ink-soft');
  }

  /** @returns {number} [m] how far the chosen robot reaches */
  get rim() {
    return rim(this.screen.store.value(this.screen.chosen, 'platform'));
  }
}
