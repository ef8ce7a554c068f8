import { trace } from './palette.js';

/** [px] how near a finger must come to take a handle */
export const REACH = 24;

/**
 * @param {import('./map.js').Scene} scene
 * @param {[number, number]} place [m]
 * @param {string} colour
 */
export function drawCross({ context, view, palette }, place, colour) {
  const [column, row] = view.toScreen(...place);
  view.usePixels(context);
  context.strokeStyle = palette.colour(colour);
  context.lineWidth = 2;
  context.beginPath();
  for (const [x, y] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
    trace(context, [[column + 5 * x, row + 5 * y], [column + 16 * x, row + 16 * y]]);
  }
  context.stroke();
}

/** Drag of one handle. @returns {boolean} */
export const near = (/** @type {[number, number]} */ [a, b], /** @type {number} */ column,
  /** @type {number} */ row) => Math.hypot(a - column, b - row) < REACH;

/** Arrow keys as a step in metres. @returns {[number, number]|null} */
export function arrow(/** @type {KeyboardEvent} */ event, /** @type {number} */ step) {
  const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  const found = steps[/** @type {keyof steps} */ (event.key)];
  return found ? [found[0] * step, found[1] * step] : null;
}
