import { element, refill, write } from '../words/element.js';
import { age } from '../words/format.js';
import { phrase } from '../words/phrases.js';

/** Every node with what it says of itself, and every input with its age. */
export class HealthDrawer {
  constructor() {
    this.nodes = element('div.cards');
    this.inputs = element('tbody');
    this.body = element('div.columns', {},
      element('section', {}, element('h3', { text: phrase('nodes') }), this.nodes),
      element('section', {}, element('h3', { text: phrase('inputs') }),
        element('table', {}, element('thead', {}, element('tr', {},
          ...['topic', 'age', 'limitHead'].map((key) => element('th', { scope: 'col', text: phrase(key) })))),
        this.inputs)));
    /** @type {Set<string>} nodes whose values are shown */
    this.opened = new Set();
  }

  /** @param {import('../live/screen.js').Screen} screen */
  update({ store, chosen }) {
    const health = store.value(chosen, 'health') ?? {};
    const older = store.age(chosen, 'health');
    const nodes = health.nodes ?? [];
    refill(this.nodes, chosen + JSON.stringify(nodes.map((/** @type {any} */ node) =>
      [node.name, node.level, node.message, node.values])), () =>
      (nodes.length ? nodes.map((/** @type {any} */ node) => this._node(node))
        : [element('p.empty', { text: phrase('unknown') })]));
    nodes.forEach((/** @type {any} */ node, /** @type {number} */ index) => {
      const where = this.nodes.children[index]?.querySelector('.node-age');
      if (where) write(where, age(node.age === null ? null : node.age + older));
    });
    const inputs = health.inputs ?? [];
    refill(this.inputs, chosen + JSON.stringify(inputs.map((/** @type {any} */ input) => [input.topic, input.limit])), () =>
      inputs.map((/** @type {any} */ input) => element('tr', {},
        element('th', { scope: 'row', text: input.topic }), element('td'),
        element('td', { text: input.limit === null ? '' : age(input.limit) }))));
    inputs.forEach((/** @type {any} */ input, /** @type {number} */ index) => {
      const row = /** @type {HTMLElement} */ (this.inputs.children[index]);
      const known = input.age === null || input.age === undefined ? null : input.age + older;
      write(row.children[1], age(known));
      row.toggleAttribute('data-late', known === null || (input.limit !== null && known > input.limit));
    });
  }

  /** @param {any} node */
  _node(node) {
    const values = Object.entries(node.values ?? {});
    const details = element('details.node', {
      'data-level': String(node.level).toLowerCase(), open: this.opened.has(node.name),
      ontoggle: () => {
        if (details.open) this.opened.add(node.name);
        else this.opened.delete(node.name);
      },
    },
    element('summary', {},
      element('span.level', { text: phrase(`level ${String(node.level).toLowerCase()}`) }),
      element('span.node-name', { text: node.name }), element('span.node-age')),
    element('dl.values', {}, ...values.map(([key, value]) =>
      element('div', {}, element('dt', { text: key }), element('dd', { text: String(value) })))));
    return element('article.card', {}, details, element('p', { text: node.message }));
  }
}
