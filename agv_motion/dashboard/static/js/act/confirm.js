import { element } from '../words/element.js';
import { phrase } from '../words/phrases.js';

/**
 * Ask before something is done. The page behind stays alive: STOP can be pressed while it asks.
 *
 * @param {string} question
 * @param {string} yes what the button that does it says
 * @param {HTMLElement[]} fields to be filled in before
 * @returns {Promise<boolean>}
 */
export function confirm(question, yes, fields = []) {
  return new Promise((resolve) => {
    const dialog = element('dialog.question', { 'aria-label': question },
      element('p.question-text', { text: question }),
      ...fields,
      element('div.question-buttons', {},
        element('button', { type: 'button', text: phrase('cancel'), onclick: () => end(false) }),
        element('button.primary', { type: 'button', text: yes, onclick: () => end(true) })));
    const before = /** @type {HTMLElement|null} */ (document.activeElement);
    const end = (/** @type {boolean} */ answer) => {
      dialog.remove();
      before?.focus();
      resolve(answer);
    };
    dialog.addEventListener('keydown', (/** @type {KeyboardEvent} */ event) => {
      if (event.key === 'Escape') end(false);
      else if (event.key === 'Enter' && event.target instanceof HTMLInputElement) end(true);
    });
    document.querySelector('.question')?.remove(); // one question at a time
    document.body.append(dialog);
    dialog.show();
    (fields.length ? dialog.querySelector('input') : dialog.querySelector('.primary'))?.focus();
  });
}
