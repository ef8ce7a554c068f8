import { phrase, language } from './phrases.js';

/** @returns {boolean} */
const isNumber = (/** @type {any} */ value) => typeof value === 'number' && Number.isFinite(value);

/**
 * @param {number|null|undefined} value
 * @param {number} digits after the point
 * @param {string} unit
 * @returns {string} such as `1.25 m`, or the word for unknown
 */
export function number(value, digits = 2, unit = '') {
  if (!isNumber(value)) return phrase('unknown');
  const text = Number(value).toFixed(digits).replace('-', '\u2212');
  return unit ? `${text}\u202f${unit}` : text;
}

/** letters of a name, so that it has room beside its word, and above its robot on the map */
const LONGEST_NAME = 14;

/**
 * Shorten a name in its middle: robots of one place differ in their last letters.
 * @param {string} name
 * @returns {string}
 */
export function shortName(name) {
  if (name.length <= LONGEST_NAME) return name;
  const kept = LONGEST_NAME - 1;
  return `${name.slice(0, Math.ceil(kept / 2))}…${name.slice(-Math.floor(kept / 2))}`;
}

/**
 * @param {number|null|undefined} seconds
 * @returns {string} such as `0.3 s`, `12 s`, `4 min`, `3 h`
 */
export function age(seconds) {
  if (!isNumber(seconds)) return phrase('never');
  const value = Number(seconds);
  if (value < 10) return number(value, 1, 's');
  if (value < 120) return number(value, 0, 's');
  if (value < 7200) return number(value / 60, 0, 'min');
  return number(value / 3600, 0, 'h');
}

/**
 * @param {number|null|undefined} time seconds since 1970
 * @param {Intl.DateTimeFormatOptions} options
 */
function written(time, options) {
  if (!isNumber(time)) return phrase('unknown');
  return new Intl.DateTimeFormat(language(), options).format(new Date(Number(time) * 1000));
}

/** @returns {string} such as `13:42:07` */
export const clockTime = (/** @type {number|null|undefined} */ time) =>
  written(time, { hour: '2-digit', minute: '2-digit', second: '2-digit', hour12: false });

/** @returns {string} such as `13:42` */
export const hourMinute = (/** @type {number|null|undefined} */ time) =>
  written(time, { hour: '2-digit', minute: '2-digit', hour12: false });

/** @returns {string} such as `30 Nov, 13:42:07` */
export const dateTime = (/** @type {number|null|undefined} */ time) =>
  written(time, {
    day: 'numeric', month: 'short', hour: '2-digit', minute: '2-digit', second: '2-digit',
    hour12: false,
  });

/** @returns {string} such as `1.02 m/min`: what people can follow */
export const pace = (/** @type {number|null|undefined} */ speed) =>
  isNumber(speed) ? number(Number(speed) * 60, 2, 'm/min') : phrase('unknown');

/** @returns {string} an angle in degrees */
export const degrees = (/** @type {number|null|undefined} */ angle) =>
  isNumber(angle) ? `${number((Number(angle) * 180) / Math.PI, 0)}°` : phrase('unknown');

/** @returns {string} any value of a parameter as a person would write it */
export function plain(/** @type {any} */ value) {
  if (value === null || value === undefined) return phrase('unknown');
  if (typeof value === 'string') return value;
  return JSON.stringify(value);
}

/** @returns {{litres: string, low: string, high: string}} with as many digits each: `12.3 L`, `3.8`, `39.4` */
export function inLitres(/** @type {import('../live/types.js').Litres} */ { value, low, high }) {
  const digits = high < 10 ? 2 : 1;
  return { litres: number(value, digits, 'L'), low: number(low, digits), high: number(high, digits) };
}
