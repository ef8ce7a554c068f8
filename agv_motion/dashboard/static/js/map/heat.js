/**
 * Memory of the tree as a heat map: sap flow from shade to sun, visits from fresh to long ago.
 */

/** Ramps of colour, each from 0 to 100; chosen to be read by the colour-blind as well. */
export const RAMPS = {
  'memory/sap_flow': [[70, 100, 140], [150, 165, 175], [240, 228, 66]],
  'memory/last_visit': [[0, 158, 115], [160, 200, 180], [204, 121, 167]],
};

/** @returns {[number, number, number]} */
function colour(/** @type {number[][]} */ ramp, /** @type {number} */ share) {
  const place = Math.min(0.9999, Math.max(0, share)) * (ramp.length - 1);
  const index = Math.floor(place);
  const rest = place - index;
  const mix = (/** @type {number} */ channel) =>
    Math.round(ramp[index][channel] * (1 - rest) + ramp[index + 1][channel] * rest);
  return [mix(0), mix(1), mix(2)];
}

/** Grids as pictures; each is painted once. */
export class Heat {
  constructor() {
    /** @type {WeakMap<object, HTMLCanvasElement>} */
    this.pictures = new WeakMap();
  }

  /**
   * @param {import('./map.js').Scene} scene
   * @param {string} topic one of RAMPS
   */
  draw(scene, topic) {
    const { context, view } = scene;
    const grid = scene.store.value(scene.chosen, topic);
    if (!grid || !(grid.width > 0) || !(grid.height > 0)) return;
    let picture = this.pictures.get(grid);
    if (!picture) {
      picture = paint(grid, RAMPS[/** @type {keyof RAMPS} */ (topic)]);
      this.pictures.set(grid, picture);
    }
    const [left, bottom] = view.toScreen(grid.x, grid.y);
    const width = grid.width * grid.resolution * view.scale;
    const height = grid.height * grid.resolution * view.scale;
    view.usePixels(context);
    context.imageSmoothingEnabled = false;
    context.globalAlpha = 0.8;
    context.drawImage(picture, left, bottom - height, width, height);
    context.globalAlpha = 1;
  }
}

/** @returns {HTMLCanvasElement} a pixel a cell; the first row of the grid is the southernmost */
function paint(/** @type {import('../live/types.js').Grid} */ grid, /** @type {number[][]} */ ramp) {
  const picture = document.createElement('canvas');
  picture.width = grid.width;
  picture.height = grid.height;
  const pen = /** @type {CanvasRenderingContext2D} */ (picture.getContext('2d'));
  const image = pen.createImageData(grid.width, grid.height);
  const cells = atob(grid.cells);
  const table = Array.from({ length: 101 }, (_, value) => colour(ramp, value / 100));
  for (let row = 0; row < grid.height; row += 1) {
    for (let column = 0; column < grid.width; column += 1) {
      const value = cells.charCodeAt(row * grid.width + column);
      if (!(value <= 100)) continue; // -1, which is 255 here: unknown, left clear
      const at = 4 * ((grid.height - 1 - row) * grid.width + column);
      image.data.set([...table[value], 255], at);
    }
  }
  pen.putImageData(image, 0, 0);
  return picture;
}
