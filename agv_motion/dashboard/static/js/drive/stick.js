import { element } from '../words/element.js';

/** A part of the way in which a stick does nothing: a resting thumb trembles. */
const DEAD = 0.06;

/**
 * A stick for one thumb. It springs back and says so as soon as the pointer is up, cancelled or lost.
 */
export class Stick {
  /**
   * @param {{label: string, axes: 'both'|'across', held: () => void, released: () => void}} given
   */
  constructor({ label, axes, held, released }) {
    this.axes = axes;
    /** @type {number|null} */
    this.pointer = null;
    /** right and up, each -1 to 1 */
    this.right = 0;
    this.up = 0;
    this.heldNow = held;
    this.released = released;
    this.knob = element('span.stick-knob', { 'aria-hidden': 'true' });
    this.base = element(`div.stick.stick-${axes}`, { role: 'img', 'aria-label': label }, this.knob);
    this.base.addEventListener('pointerdown', (/** @type {PointerEvent} */ event) => this._down(event));
    this.base.addEventListener('pointermove', (/** @type {PointerEvent} */ event) => this._move(event));
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture']) {
      this.base.addEventListener(end, (/** @type {PointerEvent} */ event) => {
        if (event.pointerId === this.pointer) this.letGo();
      });
    }
    this.base.addEventListener('contextmenu', (/** @type {Event} */ event) => event.preventDefault());
  }

  /** @returns {boolean} */
  get held() {
    return this.pointer !== null;
  }

  /** Back to the middle, without a hand. */
  letGo() {
    const was = this.held;
    this.pointer = null;
    this.show(0, 0);
    this.base.toggleAttribute('data-held', false);
    if (was) this.released();
  }

  /**
   * @param {number} right -1 to 1
   * @param {number} up -1 to 1
   */
  show(right, up) {
    this.right = Math.abs(right) < DEAD ? 0 : right;
    this.up = Math.abs(up) < DEAD ? 0 : up;
    this.knob.style.setProperty('--right', String(right));
    this.knob.style.setProperty('--up', String(up));
  }

  /** @param {PointerEvent} event */
  _down(event) {
    if (this.held || event.button > 0) return;
    event.preventDefault();
    this.base.setPointerCapture(event.pointerId);
    this.pointer = event.pointerId;
    this.base.toggleAttribute('data-held', true);
    this._move(event);
    this.heldNow();
  }

  /** @param {PointerEvent} event */
  _move(event) {
    if (event.pointerId !== this.pointer) return;
    const box = this.base.getBoundingClientRect();
    const across = (2 * (event.clientX - box.left)) / box.width - 1;
    const upwards = 1 - (2 * (event.clientY - box.top)) / box.height;
    if (this.axes === 'across') {
      this.show(Math.max(-1, Math.min(1, across)), 0);
      return;
    }
    const length = Math.max(1, Math.hypot(across, upwards));
    this.show(across / length, upwards / length);
  }
}
