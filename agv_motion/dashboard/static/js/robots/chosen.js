import { confirm } from '../act/confirm.js';
import { element, refill, write } from '../words/element.js';
import { degrees, inLitres, number, pace } from '../words/format.js';
import { phrase } from '../words/phrases.js';

/**
 * The chosen robot: what it does in numbers, and what a person may tell it.
 */
export class Chosen {
  /**
   * @param {import('../act/actions.js').Actions} actions
   * @param {HTMLElement} where
   * @param {{drive: () => void, place: () => void}} doors to what has a panel of its own
   */
  constructor(actions, where, doors) {
    this.actions = actions;
    this.doors = doors;
    this.facts = element('dl.facts');
    this.buttons = element('div.buttons');
    where.append(this.facts, this.buttons);
  }

  /** @param {import('../live/screen.js').Screen} screen */
  update(screen) {
    const { store, chosen } = screen;
    const summary = store.value(chosen, 'summary');
    const facts = this._facts(store, chosen, summary);
    refill(this.facts, facts.map(([word]) => word).join('\n'), () =>
      facts.map(([word]) => element('div', {}, element('dt', { text: word }), element('dd'))));
    facts.forEach(([, value], index) => write(this.facts.children[index].lastElementChild, value));
    this._drawButtons(screen, summary);
  }

  /**
   * @param {import('../live/store.js').Store} store
   * @param {string} robot
   * @param {any} summary
   * @returns {[string, string][]}
   */
  _facts(store, robot, summary) {
    if (!robot) return [];
    const twist = store.value(robot, 'twist');
    const driver = store.value(robot, 'driver');
    const goal = store.value(robot, 'goal');
    /** @type {[string, string][]} */
    const facts = [
      [phrase('speed'), twist ? pace(Math.hypot(twist.vx ?? NaN, twist.vy ?? NaN)) : phrase('unknown')],
      [phrase('turning'), twist ? `${degrees(twist.wz === null ? null : twist.wz * 60)}/min` : phrase('unknown')],
      [phrase('drivenBy'), driverName(driver)],
    ];
    if (goal) {
      const place = `(${number(goal.x, 1)}, ${number(goal.y, 1)})`;
      facts.push([phrase('goal'), goal.reason ? `${goal.reason}` : place]);
    }
    const litres = store.value(robot, 'drank')?.litres;
    if (litres) facts.push([phrase('drank'), phrase('interval', inLitres(litres))]);
    return facts;
  }

  /**
   * @param {import('../live/screen.js').Screen} screen
   * @param {any} summary
   */
  _drawButtons(screen, summary) {
    const may = ['operator', 'expert'].includes(screen.hello?.role ?? 'public') && screen.chosen;
    const paused = summary?.word === 'paused';
    const stopped = Boolean(summary?.stopped);
    const locked = Boolean(screen.store.value(screen.chosen, 'driver')?.lock);
    const told = may
      ? [screen.chosen, paused, stopped, locked, summary?.kind, summary?.rest_asked].join('\n')
      : '';
    refill(this.buttons, told, () => (may ? this._buttons(screen.chosen, summary, locked) : []));
    for (const button of this.buttons.children) {
      /** @type {HTMLButtonElement} */ (button).disabled = Boolean(screen.past);
    }
  }

  /**
   * @param {string} robot
   * @param {any} summary
   * @param {boolean} locked
   */
  _buttons(robot, summary, locked) {
    const button = (/** @type {string} */ action, /** @type {() => void} */ onclick) =>
      element('button', { type: 'button', 'data-act': action, text: phrase(`act ${action}`), onclick });
    const plain = (/** @type {string} */ action) =>
      button(action, () => this.actions.robot(robot, action));
    const tree = summary?.kind === 'tree';
    return [
      plain(summary?.word === 'paused' ? 'resume' : 'pause'),
      ...(tree ? [plain('next_goal'), plain('home'), button('rest', () => this._rest(robot))] : []),
      ...(tree && summary.rest_asked
        ? [button('end_rest', () => this.actions.robot(robot, 'rest', { until: 0 }, 'end_rest'))]
        : []),
      button('drive', () => this.doors.drive()),
      button('pose', () => this.doors.place()),
      plain(locked ? 'unlock' : 'lock'),
      plain(summary?.stopped ? 'release' : 'stop'),
    ];
  }

  /** @param {string} robot */
  async _rest(robot) {
    const field = element('input', { type: 'time', id: 'rest-until', value: '18:00' });
    const label = element('label.field', { for: 'rest-until' },
      element('span', { text: phrase('until') }), field);
    if (!(await confirm(phrase('restQuestion', { robot }), phrase('act rest'), [label]))) return;
    const [hour, minute] = field.value.split(':').map(Number);
    const now = this.actions.screen.live.time();
    const until = new Date(now * 1000);
    until.setHours(hour, minute, 0, 0);
    if (until.getTime() / 1000 <= now) until.setDate(until.getDate() + 1);
    await this.actions.robot(robot, 'rest', { until: until.getTime() / 1000 });
  }
}

/** @returns {string} */
function driverName(/** @type {any} */ driver) {
  if (!driver) return phrase('unknown');
  return driver.driver && driver.driver !== 'none' ? driver.driver : phrase('nobody');
}
