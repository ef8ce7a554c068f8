import { english } from './english.js';
import { french } from './french.js';

const TABLES = { en: english, fr: french };

const asked = new URLSearchParams(location.search).get('lang');
const chosen = asked === 'fr' || asked === 'en' ? asked : 'en';

/** @returns {'en'|'fr'} */
export const language = () => chosen;

/**
 * @param {string} key of the table
 * @param {Record<string, string>} parts that stand in the phrase as `{name}`
 * @returns {string} the phrase in the page's language, or the key if there is none
 */
export function phrase(key, parts = {}) {
  const found = TABLES[chosen][key] ?? english[key] ?? key;
  return found.replace(/\{(\w+)\}/g, (whole, name) => parts[name] ?? whole);
}

/**
 * @param {string} word a robot's own, such as `walking`
 * @returns {string} in the page's language; a word that no table has stays as the robot says it
 */
export function robotWord(word) {
  const key = `word ${word}`;
  return TABLES[chosen][key] ?? english[key] ?? word;
}

/** Write the phrases of what stands in the page from the start. */
export function writePhrases() {
  document.documentElement.lang = chosen;
  for (const where of document.querySelectorAll('[data-phrase]')) {
    where.textContent = phrase(where.getAttribute('data-phrase') ?? '');
  }
  for (const where of document.querySelectorAll('[data-label]')) {
    where.setAttribute('aria-label', phrase(where.getAttribute('data-label') ?? ''));
  }
}
