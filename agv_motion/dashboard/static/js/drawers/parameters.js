import { SavedParameters } from './saved_parameters.js';
import { element, refill, write } from '../words/element.js';
import { plain } from '../words/format.js';
import { phrase } from '../words/phrases.js';

/** Parameters of all nodes of a robot: searched, explained, changed live. */
export class ParametersDrawer {
  /**
   * @param {import('../live/screen.js').Screen} screen
   * @param {import('../act/actions.js').Actions} actions
   */
  constructor(screen, actions) {
    this.screen = screen;
    this.actions = actions;
    this.robot = '';
    this.search = element('input', { type: 'search', id: 'parameter-search', placeholder: phrase('searchHint') });
    this.changedOnly = element('input', { type: 'checkbox', id: 'parameter-changed' });
    for (const field of [this.search, this.changedOnly]) {
      field.addEventListener('input', () => this.screen.redraw('drawer'));
    }
    this.count = element('span', { role: 'status' });
    this.rows = element('div.parameters');
    this.saved = new SavedParameters(screen, actions);
    this.body = element('div.columns', {},
      element('section', {},
        element('div.search', {},
          element('label', { for: 'parameter-search', text: phrase('search') }), this.search,
          element('label.check', {}, this.changedOnly, element('span', { text: phrase('changedOnly') })), this.count),
        this.rows),
      this.saved.body);
  }

  open() {
    this._want();
  }

  close() {
    this.screen.forget([`${this.robot}/parameters`]);
    this.robot = '';
  }

  _want() {
    if (this.robot === this.screen.chosen) return;
    if (this.robot) this.screen.forget([`${this.robot}/parameters`]);
    this.robot = this.screen.chosen;
    this.screen.want([`${this.robot}/parameters`]);
    this.saved.load(this.robot);
  }

  /** @param {import('../live/screen.js').Screen} screen */
  update(screen) {
    this._want();
    const nodes = screen.store.value(screen.chosen, 'parameters')?.nodes;
    const may = screen.hello?.role === 'expert' && !screen.past;
    const wanted = this.search.value.trim().toLowerCase();
    const told = JSON.stringify([screen.chosen, nodes, may, wanted, this.changedOnly.checked]);
    // a field in which somebody writes is not taken away
    if (this.rows.contains(document.activeElement) && this.robotShown === screen.chosen && this.rows.told) return;
    refill(this.rows, told, () => {
      this.robotShown = screen.chosen;
      if (!nodes) return [element('p.empty', { text: phrase('parametersComing') })];
      let count = 0;
      const groups = nodes.map((/** @type {any} */ node) => {
        const rows = node.rows.filter((/** @type {any} */ row) => this._fits(node.node, row, wanted));
        count += rows.length;
        if (!rows.length) return null;
        return element('section.parameter-node', {}, element('h3', { text: node.node }),
          ...rows.map((/** @type {any} */ row) => this._row(node.node, row, may)));
      }).filter(Boolean);
      write(this.count, phrase('parameterCount', { count: String(count) }));
      return groups;
    });
    this.saved.update(may);
  }

  /** @param {string} node @param {any} row @param {string} wanted */
  _fits(node, row, wanted) {
    if (this.changedOnly.checked && plain(row.value) === plain(row.default)) return false;
    return !wanted || `${node} ${row.name} ${row.text} ${row.unit}`.toLowerCase().includes(wanted);
  }

  /** @param {string} node @param {any} row @param {boolean} may */
  _row(node, row, may) {
    const id = `parameter-${node}-${row.name}`;
    const changed = plain(row.value) !== plain(row.default);
    const range = row.choices?.length ? row.choices.join(', ')
      : [row.low, row.high].some((edge) => edge !== null && edge !== undefined)
        ? phrase('range', { low: plain(row.low ?? '−∞'), high: plain(row.high ?? '∞') }) : '';
    const hints = [row.text, range, changed ? phrase('default', { value: plain(row.default) }) : '',
      row.dynamic ? '' : phrase('notDynamic')].filter(Boolean).join(' · ');
    const field = may && row.dynamic ? this._field(id, row) : element('output', { id, text: plain(row.value) });
    const form = element('form.parameter', {
      'data-changed': changed,
      onsubmit: (/** @type {Event} */ event) => {
        event.preventDefault();
        this._set(node, row, field);
      },
    },
    element('label', { for: id, text: row.name }), field, element('span.unit', { text: row.unit ?? '' }),
    may && row.dynamic ? element('button.small', { type: 'submit', text: phrase('set'), 'aria-label': `${phrase('set')} ${row.name}` }) : null,
    element('p.hint', { text: hints }));
    return form;
  }

  /** @param {string} id @param {any} row */
  _field(id, row) {
    if (row.choices?.length) {
      return element('select', { id }, ...row.choices.map((/** @type {any} */ choice) =>
        element('option', { value: choice, text: choice, selected: choice === row.value })));
    }
    if (typeof row.value === 'boolean') return element('input', { id, type: 'checkbox', checked: row.value });
    return element('input', { id, value: plain(row.value), inputmode: typeof row.value === 'number' ? 'decimal' : 'text', autocomplete: 'off' });
  }

  /** @param {string} node @param {any} row @param {any} field */
  async _set(node, row, field) {
    let value = field.type === 'checkbox' ? field.checked : field.value;
    if (typeof row.value === 'number' && value.trim() !== '' && Number.isFinite(Number(value))) value = Number(value);
    if (Array.isArray(row.value)) {
      try {
        value = JSON.parse(value);
      } catch { /* the robot says what is wrong with it */ }
    }
    field.blur();
    await this.actions.robot(this.robot, 'parameters', { node, name: row.name, value });
    this.screen.want([`${this.robot}/parameters`]);
  }
}
