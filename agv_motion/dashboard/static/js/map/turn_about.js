import { arrow, near } from './handle.js';
import { trace } from './palette.js';
import { fromBody, toBody } from './view.js';

/** The centre of rotation as a handle; the drive panel turns the robot about it. */
export class TurnAbout {
  /** @param {import('./operator_map.js').OperatorMap} map */
  constructor(map) {
    this.map = map;
    const twist = map.screen.store.value(map.screen.chosen, 'twist');
    /** @type {[number, number]} in the body's frame: it goes with the robot */
    this.icr = twist?.icr ?? [0, map.rim * 1.8];
  }

  /** @returns {any} */
  get pose() {
    return this.map.screen.store.value(this.map.screen.chosen, 'pose');
  }

  /** @param {number} column @param {number} row */
  grab(column, row) {
    const { view } = this.map;
    if (!this.pose || !near(view.toScreen(...fromBody(this.pose, ...this.icr)), column, row)) return null;
    return (/** @type {number} */ c, /** @type {number} */ r) => {
      if (this.pose) this.icr = toBody(this.pose, ...view.toWorld(c, r));
    };
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const step = arrow(event, event.shiftKey ? 0.5 : 0.05);
    if (!step || !this.pose) return false;
    const [x, y] = fromBody(this.pose, ...this.icr);
    this.icr = toBody(this.pose, x + step[0], y + step[1]);
    this.map.screen.redraw('look');
    return true;
  }

  /** @param {import('./map.js').Scene} scene */
  draw({ context, view, palette }) {
    if (!this.pose) return;
    const [x, y] = fromBody(this.pose, ...this.icr);
    view.useMetres(context);
    context.beginPath();
    context.arc(x, y, Math.hypot(this.pose.x - x, this.pose.y - y), 0, 2 * Math.PI);
    context.strokeStyle = palette.colour('icr');
    context.lineWidth = view.pixels(1.5);
    context.setLineDash([view.pixels(6), view.pixels(5)]);
    context.stroke();
    context.setLineDash([]);
    view.usePixels(context);
    const [column, row] = view.toScreen(x, y);
    context.beginPath();
    context.arc(column, row, 13, 0, 2 * Math.PI);
    context.fillStyle = palette.colour('icr');
    context.fill();
    context.strokeStyle = palette.colour('halo');
    context.lineWidth = 2;
    context.beginPath();
    trace(context, [[column - 7, row], [column + 7, row]]);
    trace(context, [[column, row - 7], [column, row + 7]]);
    context.stroke();
  }
}
