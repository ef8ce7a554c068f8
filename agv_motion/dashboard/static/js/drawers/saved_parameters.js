import { confirm } from '../act/confirm.js';
import { element, refill } from '../words/element.js';
import { dateTime, plain } from '../words/format.js';
import { phrase } from '../words/phrases.js';

/** Parameters as they were saved: with date, author and comment; compared with now, and reverted. */
export class SavedParameters {
  /**
   * @param {import('../live/screen.js').Screen} screen
   * @param {import('../act/actions.js').Actions} actions
   */
  constructor(screen, actions) {
    this.screen = screen;
    this.actions = actions;
    this.robot = '';
    /** @type {any[]|null} */
    this.saved = null;
    this.trouble = '';
    this.comment = element('input', { id: 'save-comment', maxlength: '200', placeholder: phrase('commentHint') });
    this.form = element('form.save', {
      onsubmit: (/** @type {Event} */ event) => {
        event.preventDefault();
        this._save();
      },
    },
    element('label', { for: 'save-comment', text: phrase('comment') }), this.comment,
    element('button', { type: 'submit', text: phrase('save') }));
    this.list = element('ul.saved');
    this.difference = element('div.difference', { role: 'status' });
    this.body = element('section', {}, element('h3', { text: phrase('savedParameters') }),
      this.form, this.list, this.difference);
  }

  /** @param {string} robot */
  async load(robot) {
    this.robot = robot;
    this.difference.replaceChildren();
    try {
      this.saved = await this.actions.read(`/robots/${encodeURIComponent(robot)}/parameters/saved`);
      this.trouble = '';
    } catch (error) {
      this.saved = null;
      this.trouble = /** @type {Error} */ (error).message;
    }
    this.screen.redraw('drawer');
  }

  /** @param {boolean} may */
  update(may) {
    this.form.hidden = !may;
    refill(this.list, JSON.stringify([this.saved, this.trouble, may]), () => {
      if (this.trouble) return [element('li.empty', { text: this.trouble })];
      if (!this.saved?.length) return [element('li.empty', { text: phrase('nothingSaved') })];
      return this.saved.map((one) => element('li.entry', {},
        element('span.entry-time', { text: dateTime(one.at) }), element('span.entry-robot', { text: one.by ?? '' }),
        element('p.entry-text', { text: one.comment ?? '' }),
        element('span.entry-buttons', {},
          element('button.small', { type: 'button', text: phrase('compare'), onclick: () => this._compare(one) }),
          may ? element('button.small', { type: 'button', text: phrase('revert'), onclick: () => this._revert(one) }) : null)));
    });
  }

  async _save() {
    await this.actions.robot(this.robot, 'parameters/save', { comment: this.comment.value });
    this.comment.value = '';
    await this.load(this.robot);
  }

  /** @param {any} one */
  async _compare(one) {
    try {
      const rows = await this.actions.read(
        `/robots/${encodeURIComponent(this.robot)}/parameters/compare?with=${encodeURIComponent(one.id)}`);
      this.difference.replaceChildren(
        element('h3', { text: phrase('differences', { time: dateTime(one.at) }) }),
        rows.length ? element('table', {}, element('thead', {}, element('tr', {},
          ...['parameter', 'then', 'now'].map((key) => element('th', { scope: 'col', text: phrase(key) })))),
        element('tbody', {}, ...rows.map((/** @type {any} */ row) => element('tr', {},
          element('th', { scope: 'row', text: `${row.node} ${row.name}` }),
          element('td', { text: plain(row.saved) }), element('td', { text: plain(row.now) })))))
          : element('p', { text: phrase('noDifference') }));
    } catch (error) {
      this.difference.replaceChildren(element('p.refusal', { text: /** @type {Error} */ (error).message }));
    }
  }

  /** @param {any} one */
  async _revert(one) {
    await this._compare(one);
    if (!(await confirm(phrase('revertQuestion', { time: dateTime(one.at) }), phrase('revert')))) return;
    await this.actions.robot(this.robot, 'parameters/revert', { id: one.id });
    this.screen.want([`${this.robot}/parameters`]);
  }
}
