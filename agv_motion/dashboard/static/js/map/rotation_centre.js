import { rim, wheelPlaces, wheelState } from './body.js';
import { trace } from './palette.js';
import { fromBody } from './view.js';

/** [m/s] below this a robot stands */
const STANDSTILL = 1e-4;

/**
 * The centre of rotation: all wheel axes meet there. Far away: the direction it moves in.
 * @param {import('./map.js').Scene} scene
 * @param {string} robot
 */
export function drawRotationCentre(scene, robot) {
  const { context, view, palette, store } = scene;
  const pose = store.value(robot, 'pose');
  const twist = store.value(robot, 'twist');
  if (!pose || pose.x === null || !twist) return;
  const platform = store.value(robot, 'platform');
  view.usePixels(context);
  context.strokeStyle = context.fillStyle = palette.colour('icr');
  if (!twist.icr) {
    const speed = Math.hypot(twist.vx ?? 0, twist.vy ?? 0);
    if (speed < STANDSTILL) return;
    const away = rim(platform) * 1.6 + view.pixels(26);
    const start = fromBody(pose, (twist.vx / speed) * rim(platform), (twist.vy / speed) * rim(platform));
    const end = fromBody(pose, (twist.vx / speed) * away, (twist.vy / speed) * away);
    const [from, to] = [view.toScreen(...start), view.toScreen(...end)];
    const angle = Math.atan2(to[1] - from[1], to[0] - from[0]);
    context.lineWidth = 2;
    context.beginPath();
    trace(context, [from, to]);
    trace(context, [[-0.5, 9], [0, 0], [0.5, 9]].map(([turn, back]) => [
      to[0] - back * Math.cos(angle + turn), to[1] - back * Math.sin(angle + turn)]));
    context.stroke();
    return;
  }
  const centre = fromBody(pose, twist.icr[0], twist.icr[1]);
  const [column, row] = view.toScreen(...centre);
  context.lineWidth = 1;
  context.globalAlpha = 0.7;
  context.setLineDash([3, 4]);
  context.beginPath();
  for (const wheel of wheelPlaces(platform, wheelState(store, robot))) {
    trace(context, [view.toScreen(...fromBody(pose, wheel.x, wheel.y)), [column, row]]);
  }
  context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
  context.lineWidth = 2;
  context.beginPath();
  context.arc(column, row, 6, 0, 2 * Math.PI);
  trace(context, [[column - 10, row], [column + 10, row]]);
  trace(context, [[column, row - 10], [column, row + 10]]);
  context.stroke();
}
