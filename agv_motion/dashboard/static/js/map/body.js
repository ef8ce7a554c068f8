import { label, trace } from './palette.js';
import { shortName } from '../words/format.js';
import { drawUncertainty } from './uncertainty.js';

/** An arrow of the fastest wheel seen is so long, in radii of the robot. */
const ARROW = 0.75;
/** [m/s] below this a wheel stands */
const STANDSTILL = 1e-4;

/** Robots at true scale, each with its wheels and how it is known where it stands. */
export class Bodies {
  constructor() {
    /** @type {Map<string, number>} fastest wheel seen, which sets the length of the arrows */
    this.fastest = new Map();
  }

  /**
   * @param {import('./map.js').Scene} scene
   * @param {string} robot
   */
  draw(scene, robot) {
    const { context, view, store, chosen } = scene;
    const pose = store.value(robot, 'pose');
    if (!pose || [pose.x, pose.y, pose.heading].some((value) => value === null)) return;
    const platform = store.value(robot, 'platform') ?? {};
    const own = robot === chosen;
    drawUncertainty(scene, pose);
    view.useMetres(context);
    context.save();
    context.translate(pose.x, pose.y);
    context.rotate(pose.heading);
    this._outline(scene, platform, own, scene.silent(robot));
    this._wheels(scene, robot, platform);
    context.restore();
    this._name(scene, robot, pose, platform);
  }

  /**
   * @param {import('./map.js').Scene} scene
   * @param {any} platform
   * @param {boolean} own
   * @param {boolean} silent
   */
  _outline({ context, view, palette }, platform, own, silent) {
    const radius = rim(platform);
    context.beginPath();
    if (platform.outline?.length) trace(context, platform.outline, true);
    else context.arc(0, 0, radius, 0, 2 * Math.PI);
    context.fillStyle = palette.colour(own ? 'robot-fill' : 'other-fill');
    context.globalAlpha = 0.85;
    context.fill();
    context.globalAlpha = 1;
    context.strokeStyle = palette.colour(silent ? 'red' : own ? 'robot' : 'other');
    context.lineWidth = view.pixels(own ? 3 : 2);
    if (silent) context.setLineDash([view.pixels(5), view.pixels(4)]);
    context.stroke();
    context.setLineDash([]);
    // where its front is: a wedge at the rim
    context.beginPath();
    trace(context, [[radius * 0.98, 0], [radius * 0.78, radius * 0.12], [radius * 0.78, -radius * 0.12]], true);
    context.fillStyle = palette.colour(own ? 'robot' : 'other');
    context.fill();
  }

  /**
   * @param {import('./map.js').Scene} scene
   * @param {string} robot
   * @param {any} platform
   */
  _wheels({ context, view, palette, store }, robot, platform) {
    const state = wheelState(store, robot);
    const places = wheelPlaces(platform, state);
    const radius = Math.max(platform.wheel_radius ?? 0.1, view.pixels(5)); // to be seen from afar
    const speeds = state.speeds ?? [];
    const known = speeds.filter((/** @type {any} */ speed) => Number.isFinite(speed)).map(Math.abs);
    const fastest = Math.max(this.fastest.get(robot) ?? 1e-6, ...known);
    this.fastest.set(robot, fastest);
    places.forEach(({ x, y, angle }, index) => {
      context.save();
      context.translate(x, y);
      context.rotate(angle);
      const speed = speeds[index];
      if (Number.isFinite(speed) && Math.abs(speed) > STANDSTILL) {
        const length = (speed / fastest) * ARROW * rim(platform);
        drawArrow(context, view, length, palette.colour('arrow'), palette.colour('halo'));
      }
      context.beginPath();
      context.roundRect(-radius, -radius * 0.45, 2 * radius, 0.9 * radius, radius * 0.25);
      context.fillStyle = palette.colour('wheel');
      context.fill();
      context.restore();
    });
  }

  /**
   * @param {import('./map.js').Scene} scene
   * @param {string} robot
   * @param {any} pose
   * @param {any} platform
   */
  _name(scene, robot, pose, platform) {
    const { view, context, chosen } = scene;
    const [column, row] = view.toScreen(pose.x, pose.y);
    view.usePixels(context);
    const below = Math.max(14, rim(platform) * view.scale) + 13;
    label(scene, shortName(robot), column, row - below, { weight: robot === chosen ? 700 : 500, size: 14 });
  }
}

/** @returns {number} [m] how far the body reaches from its centre */
export function rim(/** @type {any} */ platform) {
  if (platform?.radius) return platform.radius;
  const reach = (platform?.outline ?? []).map((/** @type {number[]} */ [x, y]) => Math.hypot(x, y));
  return Math.max(0.3, ...reach);
}

/** @returns {any} what is measured of turrets, or of fixed wheels */
export function wheelState(/** @type {import('../live/store.js').Store} */ store, /** @type {string} */ robot) {
  return store.value(robot, 'turrets') ?? store.value(robot, 'wheels') ?? {};
}

/** @returns {{x: number, y: number, angle: number}[]} in the body's frame */
export function wheelPlaces(/** @type {any} */ platform, /** @type {any} */ state) {
  if (platform?.turrets) {
    return platform.turrets.map((/** @type {number[]} */ [x, y], /** @type {number} */ index) => ({
      x, y, angle: state?.angles?.[index] ?? 0,
    }));
  }
  return platform?.wheels ?? [];
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {import('./view.js').MapView} view
 * @param {number} length [m], negative: backwards
 * @param {string} colour
 * @param {string} halo
 */
function drawArrow(context, view, length, colour, halo) {
  const head = Math.min(Math.abs(length) * 0.6, view.pixels(8)) * Math.sign(length);
  for (const [stroke, width] of /** @type {[string, number][]} */ ([[halo, 5], [colour, 2.5]])) {
    context.beginPath();
    trace(context, [[0, 0], [length, 0]]);
    context.moveTo(length - head, head * 0.6);
    context.lineTo(length, 0);
    context.lineTo(length - head, -head * 0.6);
    context.strokeStyle = stroke;
    context.lineWidth = view.pixels(width);
    context.lineCap = context.lineJoin = 'round';
    context.stroke();
  }
}
