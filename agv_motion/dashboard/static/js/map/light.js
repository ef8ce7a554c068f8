import { label, trace } from './palette.js';
import { phrase } from '../words/phrases.js';
import { number } from '../words/format.js';

/**
 * Shade on the ground, and the sun at the edge of the map in the direction from which it shines.
 * @param {import('./map.js').Scene} scene
 */
export function drawShade({ context, view, palette, store, chosen }) {
  const sun = store.ownOrShared(chosen, 'sun');
  view.useMetres(context);
  context.fillStyle = palette.colour('shade');
  context.globalAlpha = 0.28;
  for (const polygon of sun?.shade ?? []) {
    context.beginPath();
    trace(context, polygon, true);
    context.fill();
  }
  context.globalAlpha = 1;
}

/** @param {import('./map.js').Scene} scene */
export function drawSun(scene) {
  const { context, view, palette, store, chosen } = scene;
  const sun = store.ownOrShared(chosen, 'sun');
  if (!sun) return;
  view.usePixels(context);
  const up = typeof sun.elevation === 'number' && sun.elevation > 0;
  const [middle, centre] = [view.width / 2, view.height / 2];
  let [column, row] = [view.width - 34, 34];
  if (typeof sun.azimuth === 'number') {
    const [dx, dy] = [Math.cos(sun.azimuth), -Math.sin(sun.azimuth)];
    const reach = Math.min((middle - 34) / Math.max(Math.abs(dx), 1e-6),
      (centre - 34) / Math.max(Math.abs(dy), 1e-6));
    [column, row] = [middle + dx * reach, centre + dy * reach];
    row = Math.min(row, view.height - 60);
  }
  context.beginPath();
  context.arc(column, row, 10, 0, 2 * Math.PI);
  context.fillStyle = palette.colour(up || sun.elevation === undefined ? 'sun' : 'shade');
  context.fill();
  context.strokeStyle = palette.colour('ink');
  context.lineWidth = 1.5;
  context.stroke();
  if (up || sun.elevation === undefined) {
    context.beginPath();
    for (let ray = 0; ray < 8; ray += 1) {
      const [x, y] = [Math.cos((ray * Math.PI) / 4), Math.sin((ray * Math.PI) / 4)];
      context.moveTo(column + 13.5 * x, row + 13.5 * y);
      context.lineTo(column + 18 * x, row + 18 * y);
    }
    context.stroke();
  }
  const lux = typeof sun.illuminance === 'number' ? number(sun.illuminance / 1000, 0, 'klx') : '';
  const words = lux || (up ? '' : phrase('night'));
  const align = column > middle ? 'right' : 'left';
  label(scene, words, column + (align === 'right' ? -24 : 24), row, { align, size: 12 });
}
