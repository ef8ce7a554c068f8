import { HealthDrawer } from './health.js';
import { LogDrawer } from './log.js';
import { ParametersDrawer } from './parameters.js';
import { ProbesDrawer } from './probes.js';
import { ReportsDrawer } from './reports.js';
import { WhyDrawer } from './why.js';
import { ZoneDrawer } from './zone.js';
import { byId, element, refill, write } from '../words/element.js';
import { phrase } from '../words/phrases.js';

/**
 * The engineer's drawers: one open at a time, opened and closed by its tab.
 *
 * @typedef {{body: HTMLElement, update: (screen: import('../live/screen.js').Screen,
 *   changed: Set<string>) => void, open?: () => void, close?: () => void}} Drawer
 */
export class Drawers {
  /**
   * @param {import('../live/screen.js').Screen} screen
   * @param {import('../act/actions.js').Actions} actions
   * @param {import('../map/operator_map.js').OperatorMap} map
   * @param {() => void} opening called before a drawer opens
   */
  constructor(screen, actions, map, opening) {
    this.opening = opening;
    this.where = byId('drawer');
    /** @type {Record<string, Drawer>} */
    this.drawers = {
      why: new WhyDrawer(),
      probes: new ProbesDrawer(screen),
      health: new HealthDrawer(),
      parameters: new ParametersDrawer(screen, actions),
      zone: new ZoneDrawer(screen, actions, map),
      log: new LogDrawer(screen, actions),
      reports: new ReportsDrawer(actions),
    };
    this.opened = '';
    this.badge = element('span.badge');
    this.tabs = Object.fromEntries(Object.keys(this.drawers).map((name) => [name, element('button.tab', {
      type: 'button', 'aria-expanded': 'false', 'aria-controls': 'drawer', 'data-drawer': name,
      onclick: () => this.toggle(name),
    }, element('span', { text: phrase(`drawer ${name}`) }), name === 'log' ? this.badge : null)]));
    byId('drawer-tabs').append(...Object.values(this.tabs));
    this.title = element('h2');
    this.robot = element('select', { 'aria-label': phrase('robots'), onchange: () => screen.choose(this.robot.value) });
    this.where.append(
      element('header.drawer-head', {}, element('div.drawer-title', {}, this.title, this.robot),
        element('button', { type: 'button', id: 'drawer-close', text: phrase('close'), onclick: () => this.toggle(this.opened) })),
    );
  }

  /** Open a drawer, or close it if it is the one that is open. */
  toggle(/** @type {string} */ name) {
    const before = this.opened;
    if (before) {
      this.drawers[before].close?.();
      this.drawers[before].body.remove();
      this.tabs[before].setAttribute('aria-expanded', 'false');
    }
    this.opened = name === before ? '' : name;
    this.where.hidden = !this.opened;
    document.body.toggleAttribute('data-drawer', Boolean(this.opened));
    if (this.opened) {
      this.opening();
      const drawer = this.drawers[this.opened];
      drawer.open?.();
      drawer.body.classList.add('drawer-body');
      drawer.body.tabIndex = 0; // so that keys scroll it
      this.where.append(drawer.body);
      this.tabs[this.opened].setAttribute('aria-expanded', 'true');
      this.where.setAttribute('aria-label', phrase(`drawer ${this.opened}`));
    } else if (before) {
      this.tabs[before].focus();
    }
    this.shown?.redraw('drawer');
  }

  close() {
    if (this.opened) this.toggle(this.opened);
  }

  /** @param {import('../live/screen.js').Screen} screen @param {Set<string>} changed */
  update(screen, changed) {
    this.shown = screen;
    const open = (screen.live.value('', 'alerts') ?? [])
      .filter((/** @type {any} */ alert) => !alert.cleared || !alert.acknowledged).length;
    write(this.badge, open ? String(open) : '');
    if (!this.opened) return;
    write(this.title, phrase(`drawer ${this.opened}`));
    refill(this.robot, screen.robots.join('\n'), () =>
      screen.robots.map((robot) => element('option', { value: robot, text: robot })));
    this.robot.hidden = ['log', 'reports'].includes(this.opened) || screen.robots.length < 2;
    if (this.robot.value !== screen.chosen) this.robot.value = screen.chosen;
    this.drawers[this.opened].update(screen, changed);
  }
}
