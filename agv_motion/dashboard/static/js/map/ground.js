import { label, trace } from './palette.js';
import { phrase } from '../words/phrases.js';
import { number } from '../words/format.js';

/** Lines of the grid are at least so far apart [px]. */
const GRID = 42;

/**
 * The floor: zone by its rim, band that the robots keep clear of, holes, delicate floor, home.
 * @param {import('./map.js').Scene} scene
 */
export function drawGround(scene) {
  const { context, view, palette, zone } = scene;
  view.usePixels(context);
  context.fillStyle = palette.colour('paper');
  context.fillRect(0, 0, view.width, view.height);
  if (!zone) {
    drawGrid(scene);
    return;
  }
  view.useMetres(context);
  context.save();
  area(context, zone);
  context.fillStyle = palette.colour('floor');
  context.fill('evenodd');
  context.clip('evenodd');
  drawGrid(scene);
  view.useMetres(context);
  drawMargin(scene);
  context.restore();
  drawDelicate(scene);
  drawHoles(scene);
  view.useMetres(context);
  context.beginPath();
  trace(context, zone.boundary, true);
  context.strokeStyle = palette.colour('floor-edge');
  context.lineWidth = view.pixels(2.5);
  context.lineJoin = 'round';
  context.stroke();
  drawHome(scene);
}

/** The way in which the floor is bounded: outside by the boundary, inside by holes. */
function area(/** @type {CanvasRenderingContext2D} */ context,
  /** @type {import('../live/types.js').Zone} */ zone) {
  context.beginPath();
  trace(context, zone.boundary, true);
  for (const hole of zone.holes ?? []) trace(context, hole, true);
}

/** @param {import('./map.js').Scene} scene */
function drawGrid({ context, view, palette }) {
  view.usePixels(context);
  const step = [1, 2, 5, 10, 20, 50, 100].find((size) => size * view.scale >= GRID) ?? 100;
  const [west, north] = view.toWorld(0, 0);
  const [east, south] = view.toWorld(view.width, view.height);
  context.beginPath();
  for (let x = Math.ceil(west / step) * step; x <= east; x += step) {
    const column = Math.round(view.toScreen(x, 0)[0]) + 0.5;
    context.moveTo(column, 0);
    context.lineTo(column, view.height);
  }
  for (let y = Math.ceil(south / step) * step; y <= north; y += step) {
    const row = Math.round(view.toScreen(0, y)[1]) + 0.5;
    context.moveTo(0, row);
    context.lineTo(view.width, row);
  }
  context.strokeStyle = palette.colour('grid');
  context.lineWidth = 1;
  context.stroke();
}

/** The band along every edge, drawn as the inner half of a broad line: the zone is clipped. */
function drawMargin(/** @type {import('./map.js').Scene} */ { context, palette, zone }) {
  if (!zone?.margin) return;
  area(context, zone);
  context.lineJoin = 'miter';
  context.strokeStyle = palette.colour('grid');
  context.lineWidth = 2 * zone.margin;
  context.globalAlpha = 0.55;
  context.stroke();
  context.globalAlpha = 1;
}

/** @param {import('./map.js').Scene} scene */
function drawDelicate(scene) {
  const { context, view, palette, zone } = scene;
  for (const polygon of zone?.translation_only ?? []) {
    view.useMetres(context);
    context.beginPath();
    trace(context, polygon, true);
    context.fillStyle = palette.colour('delicate');
    context.globalAlpha = 0.16;
    context.fill();
    context.globalAlpha = 1;
    context.setLineDash([view.pixels(2), view.pixels(5)]);
    context.lineCap = 'round';
    context.strokeStyle = palette.colour('delicate');
    context.lineWidth = view.pixels(2);
    context.stroke();
    context.setLineDash([]);
    name(scene, polygon, phrase('noTurning'));
  }
}

/** @param {import('./map.js').Scene} scene */
function drawHoles(scene) {
  const { context, view, palette, zone } = scene;
  for (const hole of zone?.holes ?? []) {
    view.usePixels(context);
    context.beginPath();
    trace(context, hole.map(([x, y]) => view.toScreen(x, y)), true);
    context.fillStyle = palette.hatching(context);
    context.fill();
    context.strokeStyle = palette.colour('floor-edge');
    context.lineWidth = 2;
    context.stroke();
  }
}

/** Write in the middle of an area, if it is large enough for it. */
function name(/** @type {import('./map.js').Scene} */ scene,
  /** @type {[number, number][]} */ polygon, /** @type {string} */ text) {
  const { context, view } = scene;
  const columns = polygon.map(([x, y]) => view.toScreen(x, y)[0]);
  const rows = polygon.map(([x, y]) => view.toScreen(x, y)[1]);
  view.usePixels(context);
  if (Math.max(...columns) - Math.min(...columns) < 7 * text.length) return;
  label(scene, text, (Math.max(...columns) + Math.min(...columns)) / 2,
    (Math.max(...rows) + Math.min(...rows)) / 2, { colour: 'ink-soft', size: 12 });
}

/** @param {import('./map.js').Scene} scene */
function drawHome({ context, view, palette, zone }) {
  if (!zone?.home) return;
  const [column, row] = view.toScreen(zone.home[0], zone.home[1]);
  view.usePixels(context);
  context.beginPath();
  trace(context, [[-8, 1], [0, -8], [8, 1], [5.5, 1], [5.5, 8], [-5.5, 8], [-5.5, 1]]
    .map(([x, y]) => [column + x, row + y]), true);
  context.strokeStyle = palette.colour('ink-soft');
  context.lineWidth = 1.8;
  context.lineJoin = 'round';
  context.stroke();
}

/** Scale bar and north, at the lower left corner. */
export function drawScale(/** @type {import('./map.js').Scene} */ scene) {
  const { context, view, palette } = scene;
  view.usePixels(context);
  const length = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200]
    .find((metres) => metres * view.scale >= 60) ?? 500;
  const [left, row, width] = [20, view.height - 20, length * view.scale];
  context.strokeStyle = palette.colour('ink');
  context.lineWidth = 2;
  context.lineCap = 'butt';
  context.beginPath();
  trace(context, [[left, row - 6], [left, row], [left + width, row], [left + width, row - 6]]);
  context.stroke();
  label(scene, number(length, length < 1 ? 1 : 0, 'm'), left + width / 2, row - 12);
  const north = left + width + 26;
  context.fillStyle = palette.colour('ink');
  context.beginPath();
  trace(context, [[north, row - 22], [north + 6, row - 2], [north, row - 7], [north - 6, row - 2]], true);
  context.fill();
  label(scene, phrase('north'), north, row - 31, { weight: 600 });
}
