const MOVES = {
  ArrowUp: [1, 0, 0], ArrowDown: [-1, 0, 0],
  ArrowLeft: [0, 1, 0], ArrowRight: [0, -1, 0],
  q: [0, 0, 1], e: [0, 0, -1],
};

/**
 * Arrow keys drive and Q and E turn, as long as the space bar is held down: the dead-man.
 * It ends when the space bar is let go or the surface loses the focus.
 */
export class DriveKeys {
  /**
   * @param {HTMLElement} surface that must have the focus
   * @param {{held: () => void, released: () => void}} told
   */
  constructor(surface, told) {
    /** @type {Set<string>} */
    this.down = new Set();
    this.told = told;
    surface.addEventListener('keydown', (event) => this._down(event));
    surface.addEventListener('keyup', (event) => this._up(event));
    surface.addEventListener('blur', () => this.letGo());
  }

  /** @returns {boolean} */
  get held() {
    return this.down.has(' ');
  }

  /** @returns {{forward: number, left: number, turn: number}} each -1 to 1 */
  get direction() {
    const sum = [0, 0, 0];
    for (const key of this.down) {
      (MOVES[/** @type {keyof MOVES} */ (key)] ?? []).forEach((part, axis) => { sum[axis] += part; });
    }
    return { forward: sum[0], left: sum[1], turn: sum[2] };
  }

  /** No key counts any more. */
  letGo() {
    const was = this.held;
    this.down.clear();
    if (was) this.told.released();
  }

  /** @returns {string} */
  static _key(/** @type {KeyboardEvent} */ event) {
    return event.key.length === 1 ? event.key.toLowerCase() : event.key;
  }

  /** @param {KeyboardEvent} event */
  _down(event) {
    const key = DriveKeys._key(event);
    if (key !== ' ' && !(key in MOVES)) return;
    event.preventDefault();
    const was = this.held;
    this.down.add(key);
    if (!was && this.held) this.told.held();
  }

  /** @param {KeyboardEvent} event */
  _up(event) {
    const key = DriveKeys._key(event);
    const was = this.held;
    this.down.delete(key);
    if (was && !this.held) {
      this.down.clear();
      this.told.released();
    }
  }
}
