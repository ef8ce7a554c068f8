/** [px] a pointer that moved less has clicked */
const CLICK = 6;

/**
 * Pan, zoom and pinch by mouse, finger, pen and keys; drags of handles; clicks.
 *
 * @typedef {{grab?: (column: number, row: number) => ((column: number, row: number,
 *     done: boolean) => void)|null,
 *   click?: (column: number, row: number) => void,
 *   key?: (event: KeyboardEvent) => boolean,
 *   moved: () => void, fit: () => void}} Hands
 */
export class Gestures {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {import('./view.js').MapView} view
   * @param {Hands} hands
   */
  constructor(canvas, view, hands) {
    this.canvas = canvas;
    this.view = view;
    this.hands = hands;
    /** @type {Map<number, [number, number]>} */
    this.pointers = new Map();
    this.travel = 0;
    /** @type {((column: number, row: number, done: boolean) => void)|null} */
    this.held = null;
    canvas.addEventListener('pointerdown', (event) => this._down(event));
    canvas.addEventListener('pointermove', (event) => this._move(event));
    canvas.addEventListener('pointerup', (event) => this._up(event, true));
    canvas.addEventListener('pointercancel', (event) => this._up(event, false));
    canvas.addEventListener('wheel', (event) => this._wheel(event), { passive: false });
    canvas.addEventListener('keydown', (event) => this._key(event));
  }

  /** @returns {[number, number]} */
  _place(/** @type {MouseEvent} */ event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** @param {PointerEvent} event */
  _down(event) {
    if (event.button > 0) return;
    const place = this._place(event);
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, place);
    if (this.pointers.size === 1) {
      this.travel = 0;
      this.held = this.hands.grab?.(...place) ?? null;
    } else {
      this.travel = Infinity; // two fingers do not click
      this.held = null;
    }
  }

  /** @param {PointerEvent} event */
  _move(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const place = this._place(event);
    const step = [place[0] - before[0], place[1] - before[1]];
    this.travel += Math.hypot(step[0], step[1]);
    if (this.held) {
      this.held(...place, false);
    } else if (this.pointers.size === 1) {
      if (this.travel >= CLICK) this.view.pan(step[0], step[1]);
    } else {
      this._pinch(event.pointerId, before, place);
    }
    this.pointers.set(event.pointerId, place);
    this.hands.moved();
  }

  /**
   * @param {number} moved id of the finger
   * @param {[number, number]} before
   * @param {[number, number]} place
   */
  _pinch(moved, before, place) {
    const other = [...this.pointers].find(([id]) => id !== moved)?.[1];
    if (!other) return;
    const distance = (/** @type {[number, number]} */ [x, y]) =>
      Math.max(20, Math.hypot(x - other[0], y - other[1]));
    this.view.zoomAt(distance(place) / distance(before), other[0], other[1]);
  }

  /**
   * @param {PointerEvent} event
   * @param {boolean} regular
   */
  _up(event, regular) {
    if (!this.pointers.delete(event.pointerId)) return;
    const place = this._place(event);
    if (this.held) {
      this.held(...place, true);
      this.held = null;
    } else if (regular && this.travel < CLICK) {
      this.hands.click?.(...place);
    }
    this.hands.moved();
  }

  /** @param {WheelEvent} event */
  _wheel(event) {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? event.deltaY * 16 : event.deltaY;
    this.view.zoomAt(Math.exp(-Math.max(-200, Math.min(200, lines)) / 300), ...this._place(event));
    this.hands.moved();
  }

  /** @param {KeyboardEvent} event */
  _key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (this.hands.key?.(event)) {
      event.preventDefault();
      return;
    }
    const step = event.shiftKey ? 150 : 50;
    const pan = {
      ArrowLeft: [step, 0], ArrowRight: [-step, 0], ArrowUp: [0, step], ArrowDown: [0, -step],
    }[event.key];
    const zoom = { '+': 1.25, '=': 1.25, '-': 0.8 }[event.key];
    if (pan) this.view.pan(pan[0], pan[1]);
    else if (zoom) this.view.zoomAt(zoom, this.view.width / 2, this.view.height / 2);
    else if (event.key === 'f' || event.key === '0') this.hands.fit();
    else return;
    event.preventDefault();
    this.hands.moved();
  }
}
