/**
 * Make an element. Text is set as text, never as markup: a robot may call itself what it likes.
 *
 * @param {string} tag such as `button` or `button.primary`
 * @param {Record<string, any>} properties attributes; `on...` listeners; `text`
 * @param {(Node|string|null)[]} children
 * @returns {any} the HTMLElement
 */
export function element(tag, properties = {}, ...children) {
  const [name, ...classes] = tag.split('.');
  const made = document.createElement(name);
  if (classes.length) made.className = classes.join(' ');
  for (const [key, value] of Object.entries(properties)) {
    if (key === 'text') made.textContent = value;
    else if (key.startsWith('on')) made.addEventListener(key.slice(2), value);
    else if (typeof value === 'boolean') made.toggleAttribute(key, value);
    else if (value !== null && value !== undefined) made.setAttribute(key, value);
  }
  made.append(...children.filter((child) => child !== null));
  return made;
}

/**
 * Write a text, if it is another than what stands there: so no screen reader says it twice.
 * @param {Element} where
 * @param {string} text
 */
export function write(where, text) {
  if (where.textContent !== text) where.textContent = text;
}

/**
 * @param {string} id
 * @returns {any} the element, which must be there
 */
export function byId(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`no element with id ${id} in the page`);
  return found;
}

/**
 * Replace the children of an element, unless what they tell is the same as before.
 * @param {any} where
 * @param {string} told all that the children are made from
 * @param {() => (Node|string)[]} make
 */
export function refill(where, told, make) {
  if (where.told === told) return;
  where.told = told;
  where.replaceChildren(...make());
}
