import { near } from './handle.js';

/** Corners of a zone as handles. */
export class ZoneEdit {
  /**
   * @param {import('./operator_map.js').OperatorMap} map
   * @param {{zone: any, changed: () => void}} given
   */
  constructor(map, given) {
    this.map = map;
    this.given = given;
    map.draft = given.zone;
  }

  end() {
    this.map.draft = null;
  }

  /** @returns {[number, number][]} all corners, each the very array that the zone holds */
  get corners() {
    const { boundary, holes, translation_only: delicate, home } = this.given.zone;
    return [...boundary, ...holes.flat(), ...delicate.flat(), ...(home ? [home] : [])];
  }

  /** @param {number} column @param {number} row */
  grab(column, row) {
    const { view } = this.map;
    const corner = this.corners.find((place) => near(view.toScreen(...place), column, row));
    if (!corner) return null;
    return (/** @type {number} */ c, /** @type {number} */ r, /** @type {boolean} */ done) => {
      const [x, y] = view.toWorld(c, r);
      corner[0] = Math.round(x * 20) / 20;
      corner[1] = Math.round(y * 20) / 20;
      if (done) this.given.changed();
    };
  }

  /** @param {import('./map.js').Scene} scene */
  draw({ context, view, palette }) {
    view.usePixels(context);
    for (const corner of this.corners) {
      const [column, row] = view.toScreen(...corner);
      context.beginPath();
      context.arc(column, row, 9, 0, 2 * Math.PI);
      context.fillStyle = palette.colour('halo');
      context.fill();
      context.strokeStyle = palette.colour('goal');
      context.lineWidth = 3;
      context.stroke();
    }
  }
}
