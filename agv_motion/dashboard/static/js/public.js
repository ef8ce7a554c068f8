/** The public view: the map, each robot's word, and what it drank. Nothing here can act. */
import { drankToday } from './drawers/probes.js';
import { Screen } from './live/screen.js';
import { WorldMap } from './map/map.js';
import { OLD, verdict } from './robots/verdict.js';
import { byId, element, refill, write } from './words/element.js';
import { language, phrase, writePhrases } from './words/phrases.js';

writePhrases();
const other = language() === 'fr' ? 'en' : 'fr';
const link = byId('other-language');
link.textContent = { en: 'English', fr: 'Français' }[other];
link.href = `?lang=${other}`;
link.lang = link.hreflang = other;

const screen = new Screen('/live?public=1');
const map = new WorldMap(screen, byId('map-canvas'));
map.layers = new Set(['trail', 'light']);
screen.add(map);
screen.add({
  update() {
    const old = screen.live.silence() > OLD;
    const silent = byId('silent');
    silent.hidden = !(old && screen.hello);
    write(silent, silent.hidden ? '' : phrase('publicSilent'));
    document.body.toggleAttribute('data-stale', old && Boolean(screen.hello));
    const others = screen.robots.some((robot) =>
      ['differential', 'omni'].includes(screen.live.value(robot, 'summary')?.kind));
    document.title = phrase(others ? 'publicRobots' : 'publicTitle');
    write(byId('public-title'), document.title);
    const rows = screen.robots.map((robot) => {
      const { word } = verdict(screen, robot);
      return { robot, word, drank: drankToday(screen.live.value(robot, 'drank')) };
    });
    refill(byId('public-robots'), JSON.stringify(rows), () => rows.map(({ robot, word, drank }) =>
      element('li', {}, element('span.public-name', { text: robot }),
        element('span.public-word', { text: word }), element('span.public-drank', { text: drank }))));
  },
});
