/** The page to log in: sends the password as JSON, so that no foreign form can. */
import { byId, write } from './words/element.js';
import { phrase, writePhrases } from './words/phrases.js';

writePhrases();
byId('login').addEventListener('submit', async (/** @type {SubmitEvent} */ event) => {
  event.preventDefault();
  const refusal = byId('refusal');
  write(refusal, '');
  try {
    const answer = await fetch('/login', {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify({ user: byId('user').value, password: byId('password').value }),
    });
    if (answer.ok) {
      location.assign('/');
      return;
    }
    const told = await answer.json().catch(() => ({}));
    write(refusal, told.error ?? `${answer.status} ${answer.statusText}`);
  } catch {
    write(refusal, phrase('noConnection'));
  }
  byId('password').focus();
});
