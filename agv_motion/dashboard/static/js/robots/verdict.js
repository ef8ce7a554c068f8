import { age, clockTime } from '../words/format.js';
import { phrase, robotWord } from '../words/phrases.js';

/** [s] data older than this are not shown as if they were new */
export const OLD = 2;

const RANK = { green: 0, yellow: 1, red: 2 };

/**
 * What the page says of a robot: the robot's own words, or, where nothing is heard, that.
 *
 * @typedef {{robot: string, colour: 'green'|'yellow'|'red', word: string, sentence: string,
 *   silent: boolean}} Verdict
 *
 * @param {import('../live/screen.js').Screen} screen
 * @param {string} robot
 * @returns {Verdict}
 */
export function verdict(screen, robot) {
  const store = screen.store;
  const summary = store.value(robot, 'summary');
  const silence = store.silenceOf(robot);
  if (!screen.past && silence > OLD && summary?.word !== 'silent') {
    const since = Number.isFinite(silence)
      ? phrase('silentSince', { time: clockTime(Date.now() / 1000 - silence), age: age(silence) })
      : phrase('notYetHeard');
    return { robot, colour: 'red', word: robotWord('silent'), sentence: since, silent: true };
  }
  if (!summary) {
    return {
      robot, colour: 'yellow', word: robotWord('unknown'), sentence: phrase('notYetHeard'),
      silent: true,
    };
  }
  return {
    robot,
    colour: summary.colour in RANK ? summary.colour : 'red',
    word: robotWord(summary.word),
    sentence: forPeople(summary.sentence ?? ''),
    silent: summary.word === 'silent',
  };
}

/**
 * @param {import('../live/screen.js').Screen} screen
 * @returns {Verdict[]} of all robots, in their order
 */
export const verdicts = (screen) => screen.robots.map((robot) => verdict(screen, robot));

/**
 * @param {Verdict[]} all
 * @param {string} chosen
 * @returns {Verdict|undefined} the worst; the chosen one among equals
 */
export function worst(all, chosen) {
  const rank = (/** @type {Verdict} */ one) => RANK[one.colour] * 2 + Number(one.robot === chosen);
  return all.reduce((/** @type {Verdict|undefined} */ found, one) =>
    (!found || rank(one) > rank(found) ? one : found), undefined);
}

/**
 * Leave out what one would type on a command line: the page has buttons for it.
 * @param {string} sentence of a robot
 * @returns {string}
 */
export const forPeople = (sentence) =>
  sentence.split('; ').filter((clause) => !clause.includes('~/')).join('; ') || sentence;
