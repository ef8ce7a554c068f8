import { DriveKeys } from './keys.js';
import { DriveSocket } from './drive_socket.js';
import { Stick } from './stick.js';
import { forPeople } from '../robots/verdict.js';
import { byId, element, refill, write } from '../words/element.js';
import { degrees, pace } from '../words/format.js';
import { phrase } from '../words/phrases.js';

/** [m/s], [rad/s] at full deflection where the robot does not tell: a metre a minute, as a tree walks */
const FALLBACK = { speed: 1 / 60, turn: 1 / 60 };

/** [ms] after the socket closed it is opened anew, if the page hears the server again */
const REOPEN_AFTER = 2000;

/**
 * Drive by hand: stick, keys, or turning about a point that is dragged on the map.
 */
export class DrivePanel {
  /**
   * @param {import('../live/screen.js').Screen} screen
   * @param {import('../map/operator_map.js').OperatorMap} map
   * @param {import('../act/actions.js').Actions} actions
   */
  constructor(screen, map, actions) {
    this.screen = screen;
    this.actions = actions;
    /** whether this panel has locked the robot to the hand, and so unlocks it */
    this.locked = false;
    this.map = map;
    /** @type {DriveSocket|null} */
    this.socket = null;
    this.robot = '';
    this.share = 0.5;
    /** @type {any} */
    this.turning = null;
    /** @type {HTMLElement|null} */
    this.panel = null;
    this.closedAt = Infinity;
  }

  /**
   * Open the panel for the chosen robot; the hand is not on yet. As long as it is open the robot
   * obeys the hand alone: it does not walk on whenever the stick is let go.
   */
  show() {
    this.hide();
    if (!this.map.mayAct || !this.screen.chosen) return;
    this.robot = this.screen.chosen;
    this._build();
    this._open();
    this._lock();
    byId('main').append(/** @type {HTMLElement} */ (this.panel));
    document.body.toggleAttribute('data-driving', true);
    this.surface.focus({ preventScroll: true });
  }

  _open() {
    this.closedAt = Infinity;
    this.socket = new DriveSocket(this.robot, this.screen.hello?.csrf ?? '',
      (state, text) => this._told(state, text));
  }

  /** Close it: the hand is off. */
  hide() {
    this.socket?.close();
    this.socket = null;
    if (this.turning) this.map.end();
    this.turning = null;
    if (this.locked) this.actions.robot(this.robot, 'unlock');
    this.locked = false;
    document.body.toggleAttribute('data-driving', false);
    this.panel?.remove();
    this.panel = null;
  }

  _lock() {
    if (this.screen.store.value(this.robot, 'driver')?.lock) return; // somebody wants it so
    this.locked = true;
    this.actions.robot(this.robot, 'lock');
  }

  /** @param {import('../live/screen.js').Screen} screen */
  update(screen) {
    if (!this.panel) return;
    if (screen.chosen !== this.robot || !this.map.mayAct) {
      this.hide();
      return;
    }
    if (screen.connected && performance.now() - this.closedAt > REOPEN_AFTER) this._open();
    if (this.turning && this.map.mode !== this.turning) this._setTurning(false);
    const twist = screen.store.value(this.robot, 'twist');
    const driver = screen.store.value(this.robot, 'driver');
    const held = Boolean(this.socket?.held);
    this.panel.toggleAttribute('data-held', held);
    write(this.reported, twist
      ? `${pace(Math.hypot(twist.vx ?? NaN, twist.vy ?? NaN))}, ${degrees(twist.wz === null ? null : twist.wz * 60)}/min`
      : phrase('unknown'));
    write(this.driver, forPeople(driver?.sentence || driver?.driver || phrase('unknown')));
    write(this.full, pace(this._limit().speed * this.share));
  }

  /** @returns {{speed: number, turn: number}} at full deflection */
  _limit() {
    const platform = this.screen.store.value(this.robot, 'platform');
    return { speed: platform?.max_speed ?? FALLBACK.speed, turn: platform?.max_turn ?? FALLBACK.turn };
  }

  get kind() {
    return this.screen.store.value(this.robot, 'platform')?.kind ?? 'tree';
  }

  _build() {
    const hand = { held: () => this._hold(), released: () => this._release() };
    const steered = this.kind !== 'differential';
    this.move = new Stick({ label: phrase('stickMove'), axes: 'both', ...hand });
    this.turn = new Stick({ label: phrase('stickTurn'), axes: 'across', ...hand });
    this.reported = element('dd');
    this.driver = element('dd');
    this.full = element('output');
    this.state = element('p.drive-state', { role: 'status' });
    this.surface = element('div.drive-surface', {
      tabindex: '0', role: 'application', 'aria-label': phrase('driveKeys'),
    }, element('p', { text: phrase(steered ? 'driveKeysSteered' : 'driveKeysDifferential') }));
    this.keys = new DriveKeys(this.surface, hand);
    const share = element('input', { type: 'range', min: '0.1', max: '1', step: '0.1', value: String(this.share), id: 'drive-share' });
    share.addEventListener('input', () => {
      this.share = Number(share.value);
      this.screen.redraw('look');
    });
    this.turnButtons = element('div.turn-buttons');
    this.panel = element('section.drive', { 'aria-label': `${phrase('act drive')} ${this.robot}` },
      element('header.drive-head', {},
        element('h2', { text: `${phrase('act drive')}: ${this.robot}` }),
        element('button', { type: 'button', id: 'drive-close', text: phrase('close'), onclick: () => this.hide() })),
      element('div.sticks', {}, this.move.base, steered ? this.turn.base : null),
      this.turnButtons,
      steered ? element('button', {
        type: 'button', id: 'drive-turn', 'aria-pressed': 'false', text: phrase('turnAbout'),
        onclick: () => this._setTurning(!this.turning),
      }) : null,
      element('dl.facts', {},
        element('div', {}, element('dt', { text: phrase('drivenBy') }), this.driver),
        element('div', {}, element('dt', { text: phrase('speed') }), this.reported)),
      this.state,
      element('label.field', { for: 'drive-share' }, element('span', { text: phrase('atFull') }), share, this.full),
      this.surface);
  }

  /** @param {boolean} on */
  _setTurning(on) {
    if (on) this.turning = this.map.begin('turn');
    else if (this.map.mode === this.turning) this.map.end();
    if (!on) this.turning = null;
    this.panel?.querySelector('#drive-turn')?.setAttribute('aria-pressed', String(Boolean(this.turning)));
    refill(this.turnButtons, String(Boolean(this.turning)), () => (this.turning
      ? [this._turnButton('turnLeft', 1), this._turnButton('turnRight', -1)] : []));
  }

  /** A button that turns as long as it is held. @returns {HTMLElement} */
  _turnButton(/** @type {string} */ key, /** @type {number} */ sign) {
    const button = element('button.hold', { type: 'button', text: phrase(key) });
    const start = () => this.socket?.hold(() => ({
      icr: this.turning?.icr ?? [0, 0], speed: sign * this._limit().speed * this.share,
    }));
    const end = () => this.socket?.release();
    button.addEventListener('pointerdown', (/** @type {PointerEvent} */ event) => {
      button.setPointerCapture(event.pointerId);
      start();
    });
    button.addEventListener('keydown', (/** @type {KeyboardEvent} */ event) => {
      if (event.key === ' ' && !event.repeat) start();
    });
    button.addEventListener('keyup', (/** @type {KeyboardEvent} */ event) => event.key === ' ' && end());
    for (const away of ['pointerup', 'pointercancel', 'lostpointercapture', 'blur']) {
      button.addEventListener(away, end);
    }
    return button;
  }

  _hold() {
    this.socket?.hold(() => this._command());
  }

  _release() {
    if (!this.move?.held && !this.turn?.held && !this.keys?.held) this.socket?.release();
  }

  /** @returns {{vx: number, vy: number, wz: number}} what stick and keys say */
  _command() {
    const { speed, turn } = this._limit();
    const keys = this.keys?.held ? this.keys.direction : { forward: 0, left: 0, turn: 0 };
    const [up, right, twist] = [this.move?.up ?? 0, this.move?.right ?? 0, this.turn?.right ?? 0];
    const clip = (/** @type {number} */ value) => Math.max(-1, Math.min(1, value)) * this.share;
    const across = clip(keys.left - right);
    if (this.kind === 'differential') {
      return { vx: clip(up + keys.forward) * speed, vy: 0, wz: clip(across / this.share + keys.turn) * turn };
    }
    return { vx: clip(up + keys.forward) * speed, vy: across * speed, wz: clip(keys.turn - twist) * turn };
  }

  /** @param {'opening'|'open'|'closed'} state @param {string} text */
  _told(state, text) {
    if (!this.state) return;
    if (state === 'closed') this.closedAt = performance.now();
    write(this.state, [phrase(`drive ${state}`), text].filter(Boolean).join(': '));
    if (state !== 'open') {
      this.move?.letGo();
      this.turn?.letGo();
      this.keys?.letGo();
    }
  }
}
