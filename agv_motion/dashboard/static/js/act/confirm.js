import { element } from '../words/element.js';
import { phrase } from '../words/phrases.js';

/**
 * Ask before something is done.
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
    const end = (/** @type {boolean} */ answer) => {
      dialog.close();
      dialog.remove();
      resolve(answer);
    };
    dialog.addEventListener('cancel', () => end(false));
    document.body.append(dialog);
    dialog.showModal();
  });
}
