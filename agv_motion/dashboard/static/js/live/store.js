import './types.js';

/** What a robot itself says, by which the page judges whether it has fallen silent. */
const SPOKEN = ['pose', 'twist', 'turrets', 'wheels', 'driver'];

/** @returns {number} [s] of the browser's steady clock: no change of the date moves it */
export const steady = () => performance.now() / 1000;

/**
 * The newest value of every slot, each with the time it was taken.
 *
 * Ages are counted on the server's clock as long as frames come, and on the browser's steady clock
 * from then on: so a value grows old also when nothing is heard any more.
 */
export class Store {
  /** @param {() => number} clock steady, in seconds */
  constructor(clock = steady) {
    this.clock = clock;
    /** @type {Map<string, {at: number, value: any}>} */
    this.slots = new Map();
    /** @type {string[]} */
    this.robots = [];
    this.offset = 0;
    /** @type {number|null} */
    this.heard = null;
  }

  /** Begin anew: what another server, or another time, told counts no more. */
  clear() {
    this.slots.clear();
  }

  /** @param {import('./types.js').Hello} hello */
  greet(hello) {
    this.clear();
    this.robots = hello.robots;
    this._heardAt(hello.now);
  }

  /**
   * Take a frame.
   * @param {import('./types.js').Frame} frame
   * @returns {Set<string>} the topics that changed
   */
  receive(frame) {
    this._heardAt(frame.now);
    const changed = new Set();
    for (const { robot, topic, at, value } of frame.updates) {
      this.slots.set(`${robot}/${topic}`, { at, value });
      if (robot && !this.robots.includes(robot)) this.robots = [...this.robots, robot];
      changed.add(topic);
    }
    return changed;
  }

  /** @param {number} now */
  _heardAt(now) {
    this.heard = this.clock();
    this.offset = now - this.heard;
  }

  /** @returns {number} [s] the server's clock, carried on by our own */
  now() {
    return this.clock() + this.offset;
  }

  /** @returns {number} [s] since anything was heard from the server */
  silence() {
    return this.heard === null ? Infinity : this.clock() - this.heard;
  }

  /**
   * @param {string} robot
   * @param {string} topic
   * @returns {any} null if it was never told
   */
  value(robot, topic) {
    return this.slots.get(`${robot}/${topic}`)?.value ?? null;
  }

  /** @returns {any} the robot's own value, or else that of all */
  ownOrShared(/** @type {string} */ robot, /** @type {string} */ topic) {
    return this.value(robot, topic) ?? this.value('', topic);
  }

  /** @returns {number} [s] Infinity if it was never told */
  age(/** @type {string} */ robot, /** @type {string} */ topic) {
    const slot = this.slots.get(`${robot}/${topic}`);
    return slot ? Math.max(0, this.now() - slot.at) : Infinity;
  }

  /** @returns {number} [s] since the robot itself said anything */
  silenceOf(/** @type {string} */ robot) {
    return Math.min(...SPOKEN.map((topic) => this.age(robot, topic)));
  }

  /** @returns {number} [s] time of the robots, which a simulation may run faster; 0: unknown */
  time() {
    const slot = this.slots.get('/clock');
    if (!slot) return this.now();
    return slot.value.time + (slot.value.factor ?? 1) * Math.max(0, this.now() - slot.at);
  }
}
