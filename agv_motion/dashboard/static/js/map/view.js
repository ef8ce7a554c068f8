/**
 * From metres of the map (x east, y north) to pixels of the canvas and back.
 */
export class MapView {
  constructor() {
    this.x = 0;
    this.y = 0;
    /** pixels per metre */
    this.scale = 20;
    this.width = 300;
    this.height = 300;
    this.ratio = 1;
    /** whether a person has moved it: then it is not fitted by itself any more */
    this.touched = false;
    /** space at the edges that other things cover [px] */
    this.inset = { left: 24, right: 24, top: 24, bottom: 48 };
  }

  /** @returns {[number, number]} pixels of a place in metres */
  toScreen(/** @type {number} */ x, /** @type {number} */ y) {
    return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale];
  }

  /** @returns {[number, number]} metres of a place in pixels */
  toWorld(/** @type {number} */ column, /** @type {number} */ row) {
    return [
      this.x + (column - this.width / 2) / this.scale,
      this.y - (row - this.height / 2) / this.scale,
    ];
  }

  /** Move the map by pixels. */
  pan(/** @type {number} */ columns, /** @type {number} */ rows) {
    this.x -= columns / this.scale;
    this.y += rows / this.scale;
  }

  /** Zoom by a factor; what lies under the pixel stays there. */
  zoomAt(/** @type {number} */ factor, /** @type {number} */ column, /** @type {number} */ row) {
    const [x, y] = this.toWorld(column, row);
    this.scale = Math.min(2000, Math.max(0.5, this.scale * factor));
    const [after, afterRow] = this.toScreen(x, y);
    this.pan(column - after, row - afterRow);
  }

  /**
   * Show all of these points.
   * @param {[number, number][]} points [m]
   */
  fit(points) {
    if (!points.length) return;
    const xs = points.map(([x]) => x);
    const ys = points.map(([, y]) => y);
    const [west, east] = [Math.min(...xs), Math.max(...xs)];
    const [south, north] = [Math.min(...ys), Math.max(...ys)];
    const { left, right, top, bottom } = this.inset;
    this.scale = Math.max(0.5, Math.min(
      200,
      (this.width - left - right) / Math.max(east - west, 1e-3),
      (this.height - top - bottom) / Math.max(north - south, 1e-3),
    ));
    this.x = (west + east) / 2 + (right - left) / 2 / this.scale;
    this.y = (south + north) / 2 + (top - bottom) / 2 / this.scale;
  }

  /** From here on the context is drawn on in metres, y upwards. */
  useMetres(/** @type {CanvasRenderingContext2D} */ context) {
    const scale = this.scale * this.ratio;
    context.setTransform(
      scale, 0, 0, -scale,
      (this.width / 2) * this.ratio - this.x * scale,
      (this.height / 2) * this.ratio + this.y * scale,
    );
  }

  /** From here on the context is drawn on in pixels, y downwards. */
  usePixels(/** @type {CanvasRenderingContext2D} */ context) {
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
  }

  /** @returns {number} [m] what is so many pixels wide */
  pixels(/** @type {number} */ count) {
    return count / this.scale;
  }
}

/** @returns {[number, number]} a point of a robot's body in the map */
export function fromBody(/** @type {{x: number, y: number, heading: number}} */ pose,
  /** @type {number} */ x, /** @type {number} */ y) {
  const [cos, sin] = [Math.cos(pose.heading), Math.sin(pose.heading)];
  return [pose.x + cos * x - sin * y, pose.y + sin * x + cos * y];
}

/** @returns {[number, number]} a point of the map in a robot's body */
export function toBody(/** @type {{x: number, y: number, heading: number}} */ pose,
  /** @type {number} */ x, /** @type {number} */ y) {
  const [cos, sin] = [Math.cos(pose.heading), Math.sin(pose.heading)];
  const [dx, dy] = [x - pose.x, y - pose.y];
  return [cos * dx + sin * dy, -sin * dx + cos * dy];
}
