/** [ms] between two messages while the hand is on: 20 Hz */
const PERIOD = 50;
/** zeros that follow when the hand is off: a robot that hears them knows that it was let go */
const ZEROS = 6;
/** [bytes] that may wait in the browser: more means the network stalls, and old words would pile up */
const LONGEST_BACKLOG = 2000;

/**
 * Carries what the hand does to the robot: 20 times a second while it is held, then zeros.
 *
 * The robot judges by the age of what arrives; here everything that could go on without a hand ends
 * it too: a hidden page, a lost focus, a closed or stalled socket.
 *
 * @typedef {{vx: number, vy: number, wz: number}|{icr: [number, number], speed: number}} Command
 */
export class DriveSocket {
  /**
   * @param {string} robot
   * @param {string} csrf
   * @param {(state: 'opening'|'open'|'closed', text: string) => void} told
   */
  constructor(robot, csrf, told) {
    this.counter = 0;
    this.timer = 0;
    /** @type {(() => Command)|null} */
    this.source = null;
    /** @type {Command[]} that are still to be sent after the hand is off */
    this.farewell = [];
    this.told = told;
    this.refusal = '';
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    this.socket = new WebSocket(
      `${scheme}://${location.host}/robots/${encodeURIComponent(robot)}/drive`);
    this.socket.onopen = () => {
      this.socket.send(JSON.stringify({ csrf }));
      told('open', '');
    };
    this.socket.onmessage = (event) => {
      const message = JSON.parse(event.data);
      this.refusal = message.error ?? message.text ?? '';
      told('open', this.refusal);
    };
    this.socket.onclose = (event) => {
      this.release();
      told('closed', event.reason || this.refusal);
    };
    this.away = () => this.release();
    this.hidden = () => document.visibilityState !== 'visible' && this.release();
    window.addEventListener('blur', this.away);
    window.addEventListener('pagehide', this.away);
    window.addEventListener('offline', this.away);
    document.addEventListener('visibilitychange', this.hidden);
    told('opening', '');
  }

  /** @returns {boolean} whether a hand is on */
  get held() {
    return this.source !== null;
  }

  /** @param {() => Command} source what the hand says now; asked for each message */
  hold(source) {
    this.source = source;
    if (this.timer) return;
    this._tell();
    this.timer = window.setInterval(() => this._tell(), PERIOD);
  }

  /** The hand is off: a zero at once, some more, and silence. */
  release() {
    if (!this.source) return;
    this.source = null;
    this.farewell = Array.from({ length: ZEROS }, () => ({ vx: 0, vy: 0, wz: 0 }));
    this._tell();
  }

  /** End for good. */
  close() {
    this.release();
    window.removeEventListener('blur', this.away);
    window.removeEventListener('pagehide', this.away);
    window.removeEventListener('offline', this.away);
    document.removeEventListener('visibilitychange', this.hidden);
    window.clearInterval(this.timer);
    this.socket.close();
  }

  _tell() {
    const command = this.source ? this.source() : this.farewell.pop();
    if (!command) {
      window.clearInterval(this.timer);
      this.timer = 0;
    } else if (this.source && this.socket.bufferedAmount > LONGEST_BACKLOG) {
      this.release();
    } else {
      this._send(command);
    }
  }

  /** @param {Command} command */
  _send(command) {
    if (this.socket.readyState !== WebSocket.OPEN) return;
    this.counter += 1;
    const t = performance.timeOrigin + performance.now();
    this.socket.send(JSON.stringify({ n: this.counter, t, ...command }));
  }
}
