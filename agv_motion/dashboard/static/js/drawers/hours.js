import { element } from '../words/element.js';
import { phrase } from '../words/phrases.js';

/** The parameter of a tree that says when it opens, and when it closes. */
const NAMES = { open: 'schedule.opens', close: 'schedule.closes' };

/** The hours in force, and a form to change them; the robot has the last word. */
export class Hours {
  /**
   * @param {import('../live/screen.js').Screen} screen
   * @param {import('../act/actions.js').Actions} actions
   */
  constructor(screen, actions) {
    this.screen = screen;
    this.actions = actions;
    this.robot = '';
    /** @type {Record<string, any>} */
    this.fields = Object.fromEntries(Object.keys(NAMES).map((name) =>
      [name, element('input', { type: 'time', name, required: true })]));
    const labelled = Object.entries(this.fields).map(([name, field]) => element('label.field', {},
      element('span', { text: phrase(name === 'close' ? 'closes' : 'opens') }), field));
    this.form = element('form.hours', {
      onsubmit: (/** @type {Event} */ event) => {
        event.preventDefault();
        this._send();
      },
    }, ...labelled, element('button', { type: 'submit', text: phrase('putInForce') }));
  }

  open() {
    this.robot = '';
  }

  close() {
    this.screen.forget([`${this.robot}/parameters`]);
  }

  /** @param {import('../live/screen.js').Screen} screen @param {boolean} may */
  update(screen, may) {
    if (this.robot !== screen.chosen) {
      if (this.robot) screen.forget([`${this.robot}/parameters`]);
      this.robot = screen.chosen;
      this.told = null;
      for (const field of Object.values(this.fields)) field.value = ''; // another's are not its own
      screen.want([`${this.robot}/parameters`]);
    }
    for (const field of this.form.elements) field.disabled = !may;
    const nodes = screen.store.value(this.robot, 'parameters')?.nodes;
    if (!nodes || nodes === this.told) return;
    this.told = nodes;
    const rows = nodes.find((/** @type {any} */ node) => node.node === 'motion_generator')?.rows ?? [];
    for (const [name, field] of Object.entries(this.fields)) {
      const row = rows.find((/** @type {any} */ one) => one.name === NAMES[/** @type {keyof NAMES} */ (name)]);
      if (row && document.activeElement !== field) field.value = row.value;
    }
  }

  async _send() {
    const { open, close } = this.fields;
    await this.actions.act('/hours',
      { robot: this.robot, open: open.value, close: close.value }, phrase('hours'));
  }
}
