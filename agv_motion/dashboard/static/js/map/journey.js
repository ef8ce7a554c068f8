import { label, trace } from './palette.js';

/**
 * Where a robot came from, where it goes and why.
 * @param {import('./map.js').Scene} scene
 * @param {string} robot
 */
export function drawJourney(scene, robot) {
  const { context, view, palette, store, chosen } = scene;
  const trail = store.value(robot, 'trail')?.points ?? [];
  view.useMetres(context);
  context.lineCap = context.lineJoin = 'round';
  if (trail.length > 1) {
    context.beginPath();
    trace(context, trail);
    context.strokeStyle = palette.colour(robot === chosen ? 'trail' : 'other');
    context.globalAlpha = 0.55;
    context.lineWidth = view.pixels(2);
    context.stroke();
    context.globalAlpha = 1;
  }
  if (robot !== chosen) return;
  const path = store.value(robot, 'path')?.points ?? [];
  if (path.length > 1) {
    context.beginPath();
    trace(context, path);
    context.setLineDash([view.pixels(9), view.pixels(6)]);
    context.strokeStyle = palette.colour('path');
    context.lineWidth = view.pixels(2.5);
    context.stroke();
    context.setLineDash([]);
  }
}

/**
 * Where the chosen robot goes, and its reason.
 * @param {import('./map.js').Scene} scene
 */
export function drawGoal(scene) {
  const { context, view, palette, store, chosen } = scene;
  const goal = store.value(chosen, 'goal');
  if (!goal || goal.x === null || goal.y === null) return;
  const [column, row] = view.toScreen(goal.x, goal.y);
  view.usePixels(context);
  context.strokeStyle = palette.colour('goal');
  context.fillStyle = palette.colour('goal');
  context.lineWidth = 2.5;
  context.beginPath();
  context.arc(column, row, 9, 0, 2 * Math.PI);
  context.stroke();
  context.beginPath();
  context.arc(column, row, 3.5, 0, 2 * Math.PI);
  context.fill();
  // the robot's words up to the place, which the map shows itself
  const words = (goal.reason ?? '').split(/:? (?:at )?\(/)[0];
  if (!words || view.height < 260) return;
  context.font = `500 13px ${palette.font}`;
  const half = context.measureText(words).width / 2 + 8;
  const at = Math.min(view.width - half, Math.max(half, column));
  label(scene, words, at, row > view.height - 70 ? row - 22 : row + 22);
}

/**
 * What the robots have reserved of the floor: held, requested, planned.
 * @param {import('./map.js').Scene} scene
 */
export function drawReservations({ context, view, palette, store, chosen }) {
  const reservations = store.value('', 'reservations') ?? [];
  view.useMetres(context);
  context.lineCap = context.lineJoin = 'round';
  for (const { robot, kind, points, width } of reservations) {
    if (robot === chosen || !points?.length) continue;
    const broad = width ?? 2 * (store.value(robot, 'platform')?.radius ?? 0.5);
    context.beginPath();
    trace(context, points.length > 1 ? points : [points[0], points[0]]);
    context.strokeStyle = palette.colour('held');
    context.globalAlpha = { held: 0.22, requested: 0.12, planned: 0.06 }[kind] ?? 0.06;
    context.lineWidth = broad;
    context.stroke();
    context.globalAlpha = 0.9;
    const dash = { held: [], requested: [7, 5], planned: [2, 6] }[kind] ?? [2, 6];
    context.setLineDash(dash.map((length) => view.pixels(length)));
    context.lineWidth = view.pixels(1.8);
    context.stroke();
    context.setLineDash([]);
    context.globalAlpha = 1;
  }
}
