import { OLD, verdicts, worst } from './verdict.js';
import { byId, element, refill, write } from '../words/element.js';
import { age, clockTime, shortName } from '../words/format.js';
import { phrase } from '../words/phrases.js';

/** [ms] between two sentences that a screen reader is given, unless the colour changes */
const CALM = 5000;

/** The bar that is read from three metres: one colour, one shape, one word, one sentence. */
export class Bar {
  constructor() {
    this.said = '';
    this.saidColour = '';
    this.saidAt = -Infinity;
  }

  /** @param {import('../live/screen.js').Screen} screen */
  update(screen) {
    const shown = this._shown(screen);
    document.body.dataset.colour = shown.colour;
    document.body.toggleAttribute('data-stale', shown.stale);
    write(byId('bar-name'), shortName(shown.name));
    byId('bar-name').title = shown.name;
    write(byId('bar-word'), shown.word);
    write(byId('bar-sentence'), shown.sentence);
    document.title = `${shown.name} ${shown.word}`.trim();
    this._announce(shown.colour, `${shown.name} ${shown.word}. ${shown.sentence}`);
    const clock = screen.store.value('', 'clock');
    write(byId('bar-clock'), screen.hello ? clockTime(screen.store.time()) : '');
    const factor = clock?.factor ?? 1;
    write(byId('bar-factor'), factor > 1.05 || factor < 0.95 ? `×${Math.round(factor)}` : '');
    this._account(screen);
  }

  /** @param {import('../live/screen.js').Screen} screen */
  _shown(screen) {
    const silence = screen.live.silence();
    if (!screen.hello) {
      return {
        colour: 'none', stale: false, name: '', word: phrase('connecting'),
        sentence: screen.connected ? '' : phrase('connectingLong'),
      };
    }
    if (silence > OLD) {
      const time = clockTime(Date.now() / 1000 - silence);
      return {
        colour: 'red', stale: true, name: '', word: phrase('noData'),
        sentence: phrase('noDataSince', { time, age: age(Math.floor(silence)) }),
      };
    }
    const all = verdicts(screen);
    const found = worst(all, screen.chosen);
    if (!found) {
      return {
        colour: 'yellow', stale: false, name: '', word: phrase('noRobots'),
        sentence: phrase('noRobotsLong'),
      };
    }
    return {
      colour: found.colour, stale: !screen.past && all.every((one) => one.silent) && found.colour === 'red',
      name: found.robot, word: found.word, sentence: found.sentence,
    };
  }

  /**
   * Speak calmly: numbers in a sentence change each second.
   * @param {string} colour
   * @param {string} sentence
   */
  _announce(colour, sentence) {
    if (sentence === this.said) return;
    const now = performance.now();
    if (colour === this.saidColour && now - this.saidAt < CALM) return;
    this.said = sentence;
    this.saidColour = colour;
    this.saidAt = now;
    write(byId('announcer'), sentence);
  }

  /** @param {import('../live/screen.js').Screen} screen */
  _account(screen) {
    const role = screen.hello?.role ?? '';
    const user = screen.hello?.user ?? '';
    refill(byId('bar-account'), `${role} ${user}`, () => {
      if (!role) return [];
      if (role === 'public') return [element('a', { href: '/login', text: phrase('logIn') })];
      // at this machine nobody has logged in, so nobody logs out
      const named = user && user !== 'local';
      const words = element('span', { text: named ? `${user}, ${phrase(`role ${role}`)}` : phrase(`role ${role}`) });
      if (!named) return [words];
      const out = element('button.quiet', {
        type: 'button', text: phrase('logOut'),
        onclick: async () => {
          await fetch('/logout', {
            method: 'POST',
            headers: { 'X-CSRF-Token': screen.hello?.csrf ?? '', 'Content-Type': 'application/json' },
            body: '{}',
          });
          location.reload();
        },
      });
      return [words, out];
    });
  }
}
