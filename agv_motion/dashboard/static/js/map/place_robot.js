import { arrow, near, REACH } from './handle.js';
import { trace } from './palette.js';
import { fromBody } from './view.js';
import { element, write } from '../words/element.js';
import { degrees, number } from '../words/format.js';
import { phrase } from '../words/phrases.js';

/** Tell a robot where it stands: drag its ghost, turn it by its nose, then confirm. */
export class PlaceRobot {
  /** @param {import('./operator_map.js').OperatorMap} map */
  constructor(map) {
    this.map = map;
    this.robot = map.screen.chosen;
    const pose = map.screen.store.value(this.robot, 'pose');
    this.pose = {
      x: pose?.x ?? map.view.x, y: pose?.y ?? map.view.y, heading: pose?.heading ?? 0,
    };
    this.words = element('p');
    map.ask(this.words,
      element('button', { type: 'button', text: phrase('cancel'), onclick: () => map.end() }),
      element('button.primary', { type: 'button', text: phrase('standsHere'), onclick: () => this._send() }));
  }

  _send() {
    const { x, y, heading } = this.pose;
    const pose = { x, y, heading: Math.atan2(Math.sin(heading), Math.cos(heading)) };
    this.map.end();
    this.map.actions.robot(this.robot, 'pose', pose);
  }

  /** @returns {[number, number]} the handle that turns it [px] */
  _nose() {
    const reach = Math.max(this.map.rim, this.map.view.pixels(48));
    return this.map.view.toScreen(...fromBody(this.pose, reach, 0));
  }

  /** @param {number} column @param {number} row */
  grab(column, row) {
    const { view } = this.map;
    if (near(this._nose(), column, row)) {
      return (/** @type {number} */ c, /** @type {number} */ r) => {
        const [x, y] = view.toWorld(c, r);
        this.pose.heading = Math.atan2(y - this.pose.y, x - this.pose.x);
      };
    }
    const [x, y] = view.toWorld(column, row);
    if (Math.hypot(x - this.pose.x, y - this.pose.y) > Math.max(this.map.rim, view.pixels(REACH))) return null;
    const offset = [this.pose.x - x, this.pose.y - y];
    return (/** @type {number} */ c, /** @type {number} */ r) => {
      const [nx, ny] = view.toWorld(c, r);
      [this.pose.x, this.pose.y] = [nx + offset[0], ny + offset[1]];
    };
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const step = arrow(event, event.shiftKey ? 1 : 0.1);
    if (step) {
      this.pose.x += step[0];
      this.pose.y += step[1];
    } else if (event.key === ',' || event.key === '.') {
      this.pose.heading += (event.key === ',' ? 1 : -1) * (Math.PI / 36);
    } else if (event.key === 'Enter') this._send();
    else return false;
    this.map.screen.redraw('look');
    return true;
  }

  /** @param {import('./map.js').Scene} scene */
  draw(scene) {
    const { context, view, palette } = scene;
    const { x, y, heading } = this.pose;
    view.useMetres(context);
    context.beginPath();
    context.arc(x, y, this.map.rim, 0, 2 * Math.PI);
    context.strokeStyle = context.fillStyle = palette.colour('goal');
    context.lineWidth = view.pixels(2.5);
    context.setLineDash([view.pixels(6), view.pixels(4)]);
    context.stroke();
    context.setLineDash([]);
    view.usePixels(context);
    const nose = this._nose();
    context.beginPath();
    trace(context, [view.toScreen(x, y), nose]);
    context.lineWidth = 2;
    context.stroke();
    context.beginPath();
    context.arc(nose[0], nose[1], 11, 0, 2 * Math.PI);
    context.fill();
    write(this.words, phrase('placeQuestion', {
      robot: this.robot, x: number(x, 2), y: number(y, 2), heading: degrees(heading),
    }));
  }
}
