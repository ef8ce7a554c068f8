import { Connection } from './connection.js';
import { Store } from './store.js';

/**
 * What the page shows: the present, or a moment of the past, through the same views.
 *
 * The live connection goes on while the past is shown: STOP, its state and the alerts are always
 * those of now.
 *
 * @typedef {{update: (screen: Screen, changed: Set<string>) => void}} View
 */
export class Screen {
  /** @param {string} path of the live connection */
  constructor(path) {
    this.live = new Store();
    /** @type {Store|null} */
    this.past = null;
    /** @type {Connection|null} */
    this.replay = null;
    /** @type {View[]} */
    this.views = [];
    /** @type {import('./types.js').Hello|null} */
    this.hello = null;
    this.connected = false;
    /** @type {string} */
    this.chosen = '';
    /** @type {Set<string>} */
    this.changed = new Set();
    /** @type {((outcome: import('./types.js').Outcome) => void)[]} */
    this.outcomes = [];
    this.drawing = false;
    this.connection = new Connection(path, {
      state: (open) => this._setConnected(open),
      hello: (hello) => this._greet(hello),
      frame: (frame) => this._receive(this.live, frame),
      outcome: (outcome) => this.outcomes.forEach((listener) => listener(outcome)),
    });
    // also when nothing comes: what is shown grows old
    window.setInterval(() => this.redraw(), 250);
  }

  /** @returns {Store} what is shown */
  get store() {
    return this.past ?? this.live;
  }

  /** @param {View} view */
  add(view) {
    this.views.push(view);
  }

  /** @param {string} robot */
  choose(robot) {
    this.chosen = robot;
    this.redraw('chosen');
  }

  /** @returns {string[]} */
  get robots() {
    return this.store.robots.length ? this.store.robots : this.live.robots;
  }

  /** @param {string[]} slots */
  want(slots) {
    this.connection.want(slots);
    this.replay?.want(slots);
  }

  /** @param {string[]} slots */
  forget(slots) {
    this.connection.forget(slots);
    this.replay?.forget(slots);
  }

  /**
   * Show the past from a moment on.
   * @param {number} at [s]
   * @param {number} rate seconds of the bag per second; 0 stands
   */
  lookBack(at, rate) {
    this.replay?.close();
    const past = new Store();
    this.past = past;
    this.replay = new Connection(`/live?at=${at.toFixed(3)}&rate=${rate}`, {
      hello: (hello) => past.greet(hello),
      frame: (frame) => this._receive(past, frame),
    });
    this.replay.want([...this.connection.wanted]);
    this.redraw('past');
  }

  /** Show the present again. */
  lookAtNow() {
    this.replay?.close();
    this.replay = null;
    this.past = null;
    this.redraw('past');
  }

  /** @param {string[]} topics that changed; all views are drawn before the next picture */
  redraw(...topics) {
    topics.forEach((topic) => this.changed.add(topic));
    if (this.drawing) return;
    this.drawing = true;
    requestAnimationFrame(() => this._draw());
  }

  _draw() {
    this.drawing = false;
    const changed = this.changed;
    this.changed = new Set();
    for (const view of this.views) {
      try {
        view.update(this, changed);
      } catch (error) {
        console.error(error); // one view that fails does not blind the others
      }
    }
  }

  /** @param {boolean} open */
  _setConnected(open) {
    this.connected = open;
    this.redraw('connection');
  }

  /** @param {import('./types.js').Hello} hello */
  _greet(hello) {
    this.hello = hello;
    this.live.greet(hello);
    // a server that has just begun may not have met the chosen one: what is pressed is for it alone
    if (!this.chosen) this.chosen = hello.robots[0] ?? '';
    this.redraw('hello');
  }

  /**
   * @param {Store} store
   * @param {import('./types.js').Frame} frame
   */
  _receive(store, frame) {
    const changed = store.receive(frame);
    if (!this.chosen) this.chosen = store.robots[0] ?? '';
    if (store === this.store || changed.has('alerts') || changed.has('summary')) {
      this.redraw(...changed);
    }
  }
}
