import './types.js';

const FIRST_WAIT = 250;
const LONGEST_WAIT = 4000;
/** [ms] an open socket that says nothing for so long is a dead one: a cut cable closes nothing */
const DEAD_AFTER = 5000;

/**
 * The websocket to the server: opens again by itself, acknowledges each frame.
 *
 * @typedef {{hello?: (hello: import('./types.js').Hello) => void,
 *   frame?: (frame: import('./types.js').Frame) => void,
 *   outcome?: (outcome: import('./types.js').Outcome) => void,
 *   state?: (open: boolean) => void}} Listener
 */
export class Connection {
  /**
   * @param {string} path such as `/live`
   * @param {Listener} listener
   */
  constructor(path, listener) {
    this.path = path;
    this.listener = listener;
    /** @type {Set<string>} */
    this.wanted = new Set();
    this.wait = FIRST_WAIT;
    this.ended = false;
    this.timer = 0;
    this.online = () => this._openNow();
    window.addEventListener('online', this.online);
    this.watch = window.setInterval(() => this._closeIfDead(), 1000);
    this._open();
  }

  /** @returns {boolean} */
  get open() {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  /**
   * Ask for slots that are sent only when asked for, such as `oak/parameters`.
   * @param {string[]} slots
   */
  want(slots) {
    for (const slot of slots) this.wanted.add(slot);
    this._sendWanted();
  }

  /** @param {string[]} slots that are not needed any more */
  forget(slots) {
    for (const slot of slots) this.wanted.delete(slot);
    this._sendWanted();
  }

  _sendWanted() {
    this.send({ want: [...this.wanted] });
  }

  /** @param {object} message */
  send(message) {
    if (this.open) this.socket?.send(JSON.stringify(message));
  }

  /** End for good. */
  close() {
    this.ended = true;
    window.removeEventListener('online', this.online);
    window.clearInterval(this.watch);
    window.clearTimeout(this.timer);
    this.socket?.close();
  }

  _openNow() {
    if (this.open || this.ended) return;
    window.clearTimeout(this.timer);
    this._open();
  }

  _open() {
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    const socket = new WebSocket(`${scheme}://${location.host}${this.path}`);
    this.socket = socket;
    this.last = performance.now();
    socket.onmessage = (event) => {
      if (socket === this.socket) this._receive(JSON.parse(event.data));
    };
    socket.onclose = () => {
      if (socket === this.socket) this._closed();
    };
  }

  _closed() {
    this.listener.state?.(false);
    if (this.ended) return;
    this.timer = window.setTimeout(() => this._open(), this.wait * (0.75 + Math.random() / 2));
    this.wait = Math.min(LONGEST_WAIT, this.wait * 2);
  }

  _closeIfDead() {
    if (this.open && performance.now() - (this.last ?? 0) > DEAD_AFTER) {
      const dead = this.socket;
      this.socket = undefined; // its close may take minutes to be told
      dead?.close();
      this._closed();
    }
  }

  /** @param {any} message */
  _receive(message) {
    this.last = performance.now();
    if (message.kind === 'hello') {
      this.wait = FIRST_WAIT;
      this.listener.state?.(true);
      this.listener.hello?.(message);
      if (this.wanted.size) this._sendWanted();
    } else if (message.kind === 'frame') {
      this.send({ ack: message.n });
      this.listener.frame?.(message);
    } else if (message.kind === 'outcome') {
      this.listener.outcome?.(message);
    }
  }
}
