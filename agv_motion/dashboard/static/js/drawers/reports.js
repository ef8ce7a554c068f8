import { element } from '../words/element.js';
import { phrase } from '../words/phrases.js';

/** The daily reports, each a page of its own. */
export class ReportsDrawer {
  /** @param {import('../act/actions.js').Actions} actions */
  constructor(actions) {
    this.actions = actions;
    this.list = element('ul.reports');
    this.body = element('div', {}, this.list);
  }

  async open() {
    try {
      const reports = await this.actions.read('/reports');
      this.list.replaceChildren(...(reports.length ? reports : [null]).map((/** @type {any} */ report) => (report
        ? element('li', {}, element('a', {
          href: report.url ?? `/reports/${report.date}.html`, target: '_blank', rel: 'noopener', text: report.date,
        })) : element('li.empty', { text: phrase('noReports') }))));
    } catch (error) {
      this.list.replaceChildren(element('li.empty', { text: /** @type {Error} */ (error).message }));
    }
  }

  update() {}
}
