import { Bodies, rim } from './body.js';
import { drawGround, drawScale } from './ground.js';
import { Heat } from './heat.js';
import { drawGoal, drawJourney, drawReservations } from './journey.js';
import { drawShade, drawSun } from './light.js';
import { Palette } from './palette.js';
import { drawRotationCentre } from './rotation_centre.js';
import { MapView } from './view.js';
import { verdict } from '../robots/verdict.js';
import { phrase } from '../words/phrases.js';

/**
 * All that a layer needs to draw itself.
 * @typedef {{context: CanvasRenderingContext2D, view: MapView, palette: Palette,
 *   store: import('../live/store.js').Store, robots: string[], chosen: string,
 *   zone: import('../live/types.js').Zone|null, silent: (robot: string) => boolean}} Scene
 */

/** The map: everything at true scale, one layer after another. */
export class WorldMap {
  /**
   * @param {import('../live/screen.js').Screen} screen
   * @param {HTMLCanvasElement} canvas
   */
  constructor(screen, canvas) {
    this.screen = screen;
    this.canvas = canvas;
    this.context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
    this.view = new MapView();
    this.palette = new Palette(() => screen.redraw('look'));
    this.heat = new Heat();
    this.bodies = new Bodies();
    /** @type {Set<string>} layers that are shown */
    this.layers = new Set(['trail', 'reservations', 'light']);
    /** @type {((scene: Scene) => void)[]} what others draw above the robots */
    this.above = [];
    /** @type {import('../live/types.js').Zone|null} a zone that is being edited */
    this.draft = null;
    this.fitted = '';
    new ResizeObserver(() => this._resize()).observe(canvas);
  }

  _resize() {
    const { clientWidth, clientHeight } = this.canvas;
    const whole = !this.view.touched;
    this.view.ratio = window.devicePixelRatio || 1;
    this.view.width = clientWidth;
    this.view.height = clientHeight;
    this.view.inset = inset(clientHeight);
    this.canvas.width = Math.round(clientWidth * this.view.ratio);
    this.canvas.height = Math.round(clientHeight * this.view.ratio);
    if (whole) this.fit();
    this.draw();
  }

  /** Show the whole zone, or where there is none, the robots. */
  fit() {
    const { store } = this.screen;
    const boundary = this.zone()?.boundary;
    const points = boundary?.length ? boundary : this.screen.robots.flatMap((robot) => {
      const pose = store.value(robot, 'pose');
      if (!pose || pose.x === null) return [];
      const reach = 3 * rim(store.value(robot, 'platform'));
      return /** @type {[number, number][]} */ (
        [[pose.x - reach, pose.y - reach], [pose.x + reach, pose.y + reach]]);
    });
    this.view.fit(points);
    this.view.touched = false;
    this.screen.redraw('look');
  }

  /** @returns {import('../live/types.js').Zone|null} */
  zone() {
    const { store, live, chosen } = this.screen;
    return this.draft ?? store.ownOrShared(chosen, 'zone') ?? live.ownOrShared(chosen, 'zone');
  }

  /** @param {import('../live/screen.js').Screen} screen */
  update(screen) {
    const told = JSON.stringify([this.zone()?.boundary ?? null, this.zone() ? 0 : screen.robots]);
    const placed = this.zone() || screen.robots.some((robot) => screen.store.value(robot, 'pose'));
    if (placed && told !== this.fitted && !this.view.touched && !this.draft) {
      this.fitted = told;
      this.fit();
    } else if (!this.zone() && !this.view.touched && this._lost()) {
      this.fit();
    }
    this.draw();
  }

  /** @returns {boolean} whether a robot has left the picture */
  _lost() {
    return this.screen.robots.some((robot) => {
      const pose = this.screen.store.value(robot, 'pose');
      if (!pose || pose.x === null) return false;
      const [column, row] = this.view.toScreen(pose.x, pose.y);
      return column < 20 || row < 20 || column > this.view.width - 20 || row > this.view.height - 20;
    });
  }

  draw() {
    const { screen, context } = this;
    const { store, chosen, robots } = screen;
    /** @type {Scene} */
    const scene = {
      context, view: this.view, palette: this.palette, store, robots, chosen, zone: this.zone(),
      silent: (robot) => verdict(screen, robot).silent,
    };
    const order = [...robots.filter((robot) => robot !== chosen), ...(chosen ? [chosen] : [])];
    drawGround(scene);
    for (const topic of ['memory/sap_flow', 'memory/last_visit']) {
      if (this.layers.has(topic)) this.heat.draw(scene, topic);
    }
    if (this.layers.has('light')) drawShade(scene);
    if (this.layers.has('reservations')) drawReservations(scene);
    if (this.layers.has('trail')) order.forEach((robot) => drawJourney(scene, robot));
    order.forEach((robot) => this.bodies.draw(scene, robot));
    if (this.layers.has('trail')) drawGoal(scene);
    if (chosen) drawRotationCentre(scene, chosen);
    if (this.layers.has('light')) drawSun(scene);
    this.above.forEach((layer) => layer(scene));
    drawScale(scene);
    this._describe(scene);
  }

  /** What the picture shows, for those who do not see it. */
  _describe(/** @type {Scene} */ { robots, store }) {
    const places = robots.map((robot) => {
      const pose = store.value(robot, 'pose');
      const place = pose && pose.x !== null
        ? `(${pose.x.toFixed(0)}, ${pose.y.toFixed(0)})` : phrase('unknown');
      return `${robot} ${place}`;
    });
    const words = `${phrase('map')}: ${places.join('; ')}`;
    if (this.canvas.getAttribute('aria-label') !== words) this.canvas.setAttribute('aria-label', words);
  }

  /** @returns {string|null} the robot at a place of the canvas */
  robotAt(/** @type {number} */ column, /** @type {number} */ row) {
    const { store } = this.screen;
    const [x, y] = this.view.toWorld(column, row);
    return this.screen.robots.find((robot) => {
      const pose = store.value(robot, 'pose');
      if (!pose || pose.x === null) return false;
      const reach = Math.max(rim(store.value(robot, 'platform')), this.view.pixels(22));
      return Math.hypot(pose.x - x, pose.y - y) <= reach;
    }) ?? null;
  }
}

/** What the tools cover: a strip at the left, on a phone at the top, and on a very low map nothing. */
function inset(/** @type {number} */ height) {
  if (height < 260) return { left: 12, right: 12, top: 12, bottom: 12 };
  if (matchMedia('(max-width: 760px), (max-height: 480px)').matches) return { left: 16, right: 16, top: 72, bottom: 56 };
  return { left: 80, right: 24, top: 24, bottom: 56 };
}
