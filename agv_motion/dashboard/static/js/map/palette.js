const NAMES = [
  'paper', 'floor', 'floor-edge', 'grid', 'ink', 'ink-soft', 'hatch', 'delicate', 'robot', 'robot-fill',
  'other', 'other-fill', 'goal', 'path', 'trail', 'wheel', 'arrow', 'icr', 'sun', 'shade', 'limit',
  'held', 'halo', 'red', 'yellow',
];

/**
 * The colours of the map as the style sheet has them, light or dark; read again when that changes.
 */
export class Palette {
  /** @param {() => void} changed */
  constructor(changed) {
    this._read();
    for (const query of ['(prefers-color-scheme: dark)', '(prefers-contrast: more)']) {
      matchMedia(query).addEventListener('change', () => {
        this._read();
        changed();
      });
    }
  }

  _read() {
    const style = getComputedStyle(document.documentElement);
    /** @type {Record<string, string>} */
    this.colours = Object.fromEntries(
      NAMES.map((name) => [name, style.getPropertyValue(`--map-${name}`).trim() || '#888']));
    this.font = style.getPropertyValue('--font').trim() || 'sans-serif';
    /** @type {CanvasPattern|null} */
    this.pattern = null;
  }

  /** @returns {string} */
  colour(/** @type {string} */ name) {
    return this.colours[name];
  }

  /** @returns {CanvasPattern|string} thin slanting lines: nobody stands here */
  hatching(/** @type {CanvasRenderingContext2D} */ context) {
    if (!this.pattern) {
      const tile = document.createElement('canvas');
      tile.width = tile.height = 8;
      const pen = /** @type {CanvasRenderingContext2D} */ (tile.getContext('2d'));
      pen.strokeStyle = this.colour('hatch');
      pen.lineWidth = 1.2;
      pen.beginPath();
      for (const shift of [-8, 0, 8]) {
        pen.moveTo(shift, 8);
        pen.lineTo(shift + 8, 0);
      }
      pen.stroke();
      this.pattern = context.createPattern(tile, 'repeat');
    }
    return this.pattern ?? this.colour('hatch');
  }
}

/**
 * Write on the map with a halo, so that it is read on any ground.
 * @param {import('./map.js').Scene} scene
 * @param {string} text
 * @param {number} column [px]
 * @param {number} row [px] of the middle of the letters
 * @param {{colour?: string, size?: number, weight?: number, align?: CanvasTextAlign}} look
 */
export function label(scene, text, column, row, look = {}) {
  const { context, palette } = scene;
  const { colour = 'ink', size = 13, weight = 500, align = 'center' } = look;
  context.font = `${weight} ${size}px ${palette.font}`;
  context.textAlign = align;
  context.textBaseline = 'middle';
  context.lineJoin = 'round';
  context.lineWidth = 4;
  context.strokeStyle = palette.colour('halo');
  context.strokeText(text, column, row);
  context.fillStyle = palette.colour(colour);
  context.fillText(text, column, row);
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {[number, number][]} points
 * @param {boolean} closed
 */
export function trace(context, points, closed = false) {
  points.forEach(([x, y], index) => (index ? context.lineTo(x, y) : context.moveTo(x, y)));
  if (closed) context.closePath();
}
