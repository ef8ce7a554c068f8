import { verdict } from './verdict.js';
import { element, write } from '../words/element.js';
import { pace, shortName } from '../words/format.js';

/** All robots, each with its word and its sentence; the chosen one is what the rest tells of. */
export class RobotList {
  /** @param {HTMLElement} where */
  constructor(where) {
    this.where = where;
    /** @type {Map<string, any>} */
    this.rows = new Map();
    where.addEventListener('keydown', (event) => this._key(event));
  }

  /** @param {import('../live/screen.js').Screen} screen */
  update(screen) {
    this.screen = screen;
    const told = screen.robots.join('\n');
    if (told !== this.told) {
      this.told = told;
      this.rows = new Map(screen.robots.map((robot) => [robot, this._row(robot)]));
      this.where.replaceChildren(...[...this.rows.values()].map((row) => row.button));
    }
    for (const [robot, row] of this.rows) {
      const { colour, word, sentence } = verdict(screen, robot);
      const chosen = robot === screen.chosen;
      row.button.dataset.colour = colour;
      row.button.setAttribute('aria-checked', String(chosen));
      const first = !this.rows.has(screen.chosen) && robot === screen.robots[0];
      row.button.tabIndex = chosen || first ? 0 : -1;
      write(row.word, word);
      write(row.sentence, sentence);
      const twist = screen.store.value(robot, 'twist');
      const moving = screen.store.value(robot, 'summary')?.moving;
      write(row.speed, moving && twist ? pace(Math.hypot(twist.vx ?? NaN, twist.vy ?? NaN)) : '');
    }
  }

  /** @param {string} robot */
  _row(robot) {
    const row = {
      word: element('span.robot-word'),
      sentence: element('span.robot-sentence'),
      speed: element('span.robot-speed'),
      button: /** @type {any} */ (null),
    };
    row.button = element('button.robot', {
      type: 'button', role: 'radio', 'data-robot': robot,
      onclick: () => this.screen?.choose(robot),
    },
    element('span.robot-shape', { 'aria-hidden': 'true' }),
    element('span.robot-name', { title: robot },
      element('span', { text: shortName(robot), 'aria-hidden': 'true' }),
      element('span.unseen', { text: robot })), row.word, row.speed, row.sentence);
    return row;
  }

  /** @param {KeyboardEvent} event */
  _key(event) {
    const step = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
    if (!step || !this.screen) return;
    event.preventDefault();
    const names = [...this.rows.keys()];
    const next = (names.indexOf(this.screen.chosen) + step + names.length) % names.length;
    this.screen.choose(names[next]);
    this.rows.get(names[next]).button.focus();
  }
}
