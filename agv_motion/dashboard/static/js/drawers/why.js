import { element, refill, write } from '../words/element.js';
import { age, clockTime } from '../words/format.js';
import { phrase } from '../words/phrases.js';

/** Why the robot does what it does: the chain from its wheels back to its probes. */
export class WhyDrawer {
  constructor() {
    this.list = element('ol.why');
    this.body = element('div', {}, this.list);
    /** @type {any[]} */
    this.ages = [];
  }

  /** @param {import('../live/screen.js').Screen} screen */
  update({ store, chosen }) {
    // the headline stands in the bar already
    const links = (store.value(chosen, 'why')?.links ?? [])
      .filter((/** @type {any} */ link) => link.name !== 'headline');
    const older = store.age(chosen, 'why');
    const told = JSON.stringify(links.map((/** @type {any} */ link) =>
      [link.name, link.level, link.sentence, link.since, link.remedy, link.limit]));
    refill(this.list, told, () => {
      this.ages = links.map(() => element('span.why-age'));
      if (!links.length) return [element('li.empty', { text: phrase('noWhy') })];
      return links.map((/** @type {any} */ link, /** @type {number} */ index) => this._link(link, this.ages[index]));
    });
    links.forEach((/** @type {any} */ link, /** @type {number} */ index) => {
      const known = link.age === null || link.age === undefined ? null : link.age + older;
      write(this.ages[index], known === null ? '' : phrase('ago', { age: age(known) }));
    });
  }

  /**
   * @param {any} link
   * @param {HTMLElement} aged
   */
  _link(link, aged) {
    const parts = [];
    if (link.since) parts.push(phrase('since', { time: moment(link.since) }));
    if (link.limit) parts.push(phrase('limit', { limit: String(link.limit) }));
    return element('li.why-link', { 'data-level': String(link.level).toLowerCase() },
      element('div.why-head', {}, element('span.why-name', { text: link.name }),
        element('span.level', { text: phrase(`level ${String(link.level).toLowerCase()}`) }), aged),
      element('p.why-sentence', { text: link.sentence }),
      parts.length ? element('p.why-limit', { text: parts.join(' · ') }) : null,
      link.remedy ? element('p.why-remedy', { text: link.remedy }) : null);
  }
}

/** @returns {string} a time of day, where seconds since 1970 are told; else what is told */
function moment(/** @type {string|number} */ since) {
  return Number(since) > 1e8 ? clockTime(Number(since)) : String(since);
}
