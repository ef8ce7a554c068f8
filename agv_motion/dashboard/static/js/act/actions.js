import { element } from '../words/element.js';
import { phrase } from '../words/phrases.js';

/** [ms] how long the word on an action stays to be read */
const SHOWN_FOR = { done: 6000, sent: 4000, refused: 20000, no_answer: 20000 };

/** [ms] that an answer may take: asking all nodes of a robot takes a while */
const PATIENCE = 30000;

/** Asks the server for something, and shows what became of it in the server's and robot's words. */
export class Actions {
  /**
   * @param {import('../live/screen.js').Screen} screen
   * @param {HTMLElement} where the outcomes are shown
   */
  constructor(screen, where) {
    this.screen = screen;
    this.where = where;
    /** @type {Map<string, HTMLElement>} */
    this.cards = new Map();
    screen.outcomes.push((outcome) => this._outcome(outcome));
  }

  /** @returns {Promise<any>} the JSON at a path */
  async read(/** @type {string} */ path) {
    const answer = await fetch(path, { headers: { Accept: 'application/json' } });
    if (!answer.ok) throw new Error(await refusal(answer));
    return answer.json();
  }

  /**
   * @param {string} path such as `/robots/oak/pause`
   * @param {object} body
   * @param {string} key the same for each try of one and the same act
   * @param {number} patience [ms] after which the server has not answered
   * @returns {Promise<{ok: boolean, status: number, body: any, text: string}>} never rejected
   */
  async post(path, body = {}, key = newKey(), patience = PATIENCE) {
    try {
      const answer = await fetch(path, {
        method: 'POST',
        headers: {
          'Content-Type': 'application/json',
          'X-CSRF-Token': this.screen.hello?.csrf ?? '',
          'Idempotency-Key': key,
        },
        body: JSON.stringify(body),
        signal: AbortSignal.timeout(patience),
      });
      if (!answer.ok) {
        return { ok: false, status: answer.status, body: null, text: await refusal(answer) };
      }
      const told = await answer.json().catch(() => ({}));
      return { ok: true, status: answer.status, body: told, text: '' };
    } catch {
      return { ok: false, status: 0, body: null, text: phrase('noConnection') };
    }
  }

  /**
   * Act, and show what becomes of it.
   * @param {string} path
   * @param {object} body
   * @param {string} title what was asked for, in words
   */
  async act(path, body, title) {
    const answer = await this.post(path, body);
    if (!answer.ok) this._show(newKey(), title, 'refused', answer.text);
    else if (answer.body.id) this._show(answer.body.id, title, 'sent', '');
    return answer;
  }

  /**
   * @param {string} robot of the chosen robot's doors
   * @param {string} action such as `next_goal`
   * @param {object} body
   * @param {string} name of what is asked for, where it is not that of the door
   */
  async robot(robot, action, body = {}, name = action) {
    const title = `${robot}: ${phrase(`act ${name}`)}`;
    return this.act(`/robots/${encodeURIComponent(robot)}/${action}`, body, title);
  }

  /** @param {import('../live/types.js').Outcome} outcome */
  _outcome(outcome) {
    this.cards.get(outcome.id)?.remove(); // of who asked: from here on each robot has its own
    const title = [outcome.robot, phrase(`act ${outcome.action}`)].filter(Boolean).join(': ');
    const done = outcome.state === 'done'; // the rest tells how to undo it by a service
    const text = done ? outcome.text.split('; ')[0] : outcome.text;
    this._show(`${outcome.id}/${outcome.robot}`, title, outcome.state, text);
  }

  /**
   * @param {string} id
   * @param {string} title
   * @param {'sent'|'done'|'refused'|'no_answer'} state
   * @param {string} text
   */
  _show(id, title, state, text) {
    const before = this.cards.get(id);
    if (before && state === 'sent') return; // its outcome was faster
    const card = element('div.outcome', { 'data-state': state },
      element('span.outcome-title', { text: title }),
      element('span.outcome-state', { text: phrase(`outcome ${state}`) }),
      element('span.outcome-text', { text }));
    if (before) before.replaceWith(card);
    else this.where.prepend(card);
    this.cards.set(id, card);
    window.setTimeout(() => {
      card.remove();
      if (this.cards.get(id) === card) this.cards.delete(id);
    }, SHOWN_FOR[state] ?? 6000);
    while (this.where.children.length > 4) this.where.lastElementChild?.remove();
  }
}

/** @returns {string} for one act, however often it has to be sent */
export function newKey() {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, '0')).join('');
}

/** @returns {Promise<string>} why the server refused, in its words */
async function refusal(/** @type {Response} */ answer) {
  const told = await answer.json().catch(() => null);
  return typeof told?.error === 'string' ? told.error : `${answer.status} ${answer.statusText}`;
}
