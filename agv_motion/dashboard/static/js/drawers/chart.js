import { number } from '../words/format.js';

const HEIGHT = 170;
const MARGIN = { left: 46, right: 92, top: 12, bottom: 24 };

/**
 * A small chart of lines over time, each named at its end; a pointer reads its values.
 *
 * @typedef {{name: string, colour: string, values: (number|null)[], dash?: number[]}} Line
 * @typedef {{times: number[], lines: Line[], unit: string, low?: number, high?: number,
 *   time: (time: number) => string, digits?: number}} Plot
 */
export class Chart {
  /** @param {string} title */
  constructor(title) {
    this.title = title;
    this.canvas = /** @type {HTMLCanvasElement} */ (document.createElement('canvas'));
    this.canvas.className = 'chart';
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', title); // until there are values
    /** @type {Plot|null} */
    this.plot = null;
    /** @type {number|null} */
    this.pointer = null;
    this.canvas.addEventListener('pointermove', (event) => {
      this.pointer = event.clientX - this.canvas.getBoundingClientRect().left;
      this.draw();
    });
    this.canvas.addEventListener('pointerleave', () => {
      this.pointer = null;
      this.draw();
    });
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  /** @param {Plot} plot */
  show(plot) {
    this.plot = plot;
    const words = plot.lines.map((line) => {
      const known = line.values.filter((value) => value !== null);
      const last = known.length ? known[known.length - 1] : null;
      return `${line.name} ${number(last, plot.digits ?? 2, plot.unit)}`;
    });
    this.canvas.setAttribute('aria-label', [this.title, words.join(', ')].filter(Boolean).join(': '));
    this.draw();
  }

  /** @returns {string} */
  _colour(/** @type {string} */ name) {
    return getComputedStyle(this.canvas).getPropertyValue(name).trim() || '#888';
  }

  draw() {
    const { canvas, plot } = this;
    const width = canvas.clientWidth;
    if (!plot || width < 50) return;
    const ratio = window.devicePixelRatio || 1;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(HEIGHT * ratio);
    const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.font = `12px ${this._colour('--font')}`;
    pen.textBaseline = 'middle';
    const frame = this._frame(plot, width);
    this._axes(pen, plot, frame);
    const ends = plot.lines.map((line) => this._line(pen, plot, line, frame));
    this._names(pen, ends);
    if (this.pointer !== null) this._reading(pen, plot, frame);
  }

  /** @param {Plot} plot @param {number} width */
  _frame({ times, lines, low, high }, width) {
    const known = lines.flatMap((line) => line.values.filter((value) => value !== null));
    let [bottom, top] = [low ?? Math.min(...known), high ?? Math.max(...known)];
    if (!Number.isFinite(bottom)) [bottom, top] = [0, 1];
    if (top - bottom < 1e-9) [bottom, top] = [bottom - 0.5, top + 0.5];
    const [first, last] = [times[0] ?? 0, times[times.length - 1] ?? 1];
    const [left, right] = [MARGIN.left, width - MARGIN.right];
    return {
      left, right, bottom, top,
      x: (/** @type {number} */ time) => left + ((time - first) / Math.max(last - first, 1e-9)) * (right - left),
      y: (/** @type {number} */ value) =>
        HEIGHT - MARGIN.bottom - ((value - bottom) / (top - bottom)) * (HEIGHT - MARGIN.top - MARGIN.bottom),
    };
  }

  /** @param {CanvasRenderingContext2D} pen @param {Plot} plot @param {any} frame */
  _axes(pen, plot, frame) {
    const span = frame.top - frame.bottom;
    const step = [1, 2, 2.5, 5, 10].map((part) => part * 10 ** Math.floor(Math.log10(span / 4)))
      .find((size) => span / size <= 4.5) ?? span;
    const digits = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9) + (String(step).includes('25') ? 1 : 0));
    pen.strokeStyle = this._colour('--line');
    pen.fillStyle = this._colour('--ink-soft');
    pen.lineWidth = 1;
    pen.textAlign = 'right';
    for (let value = Math.ceil(frame.bottom / step - 1e-9) * step; value <= frame.top + 1e-9; value += step) {
      const row = Math.round(frame.y(value)) + 0.5;
      pen.beginPath();
      pen.moveTo(frame.left, row);
      pen.lineTo(frame.right, row);
      pen.stroke();
      pen.fillText(number(value, digits), frame.left - 6, row);
    }
    pen.textAlign = 'center';
    const count = Math.max(2, Math.floor((frame.right - frame.left) / 110));
    const [first, last] = [plot.times[0] ?? 0, plot.times[plot.times.length - 1] ?? 1];
    for (let index = 0; index <= count; index += 1) {
      const time = first + ((last - first) * index) / count;
      pen.fillText(plot.time(time), frame.x(time), HEIGHT - 9);
    }
  }

  /** @param {CanvasRenderingContext2D} pen @param {Plot} plot @param {Line} line @param {any} frame */
  _line(pen, plot, line, frame) {
    pen.strokeStyle = this._colour(line.colour);
    pen.lineWidth = 2;
    pen.lineJoin = pen.lineCap = 'round';
    pen.setLineDash(line.dash ?? []);
    pen.beginPath();
    let drawing = false;
    let end = null;
    plot.times.forEach((time, index) => {
      const value = line.values[index];
      if (value === null || value === undefined || !Number.isFinite(value)) {
        drawing = false;
        return;
      }
      const place = [frame.x(time), frame.y(value)];
      if (!drawing) pen.moveTo(place[0], place[1]);
      pen.lineTo(place[0], place[1]); // also to itself: a value alone between gaps is a dot
      drawing = true;
      end = place;
    });
    pen.stroke();
    pen.setLineDash([]);
    return { line, end };
  }

  /** Names at the ends of the lines, moved apart where they would cover each other. */
  _names(/** @type {CanvasRenderingContext2D} */ pen, /** @type {{line: Line, end: any}[]} */ ends) {
    const shown = ends.filter(({ end }) => end).sort((a, b) => a.end[1] - b.end[1]);
    let above = MARGIN.top - 14;
    pen.textAlign = 'left';
    for (const { line, end } of shown) {
      const row = Math.max(end[1], above + 15);
      above = row;
      pen.fillStyle = this._colour('--ink');
      pen.fillText(line.name, end[0] + 16, row);
      pen.fillStyle = this._colour(line.colour);
      pen.fillRect(end[0] + 6, row - 4, 6, 8);
    }
  }

  /** @param {CanvasRenderingContext2D} pen @param {Plot} plot @param {any} frame */
  _reading(pen, plot, frame) {
    const at = Math.max(frame.left, Math.min(frame.right, this.pointer ?? 0));
    let nearest = 0;
    plot.times.forEach((time, index) => {
      if (Math.abs(frame.x(time) - at) < Math.abs(frame.x(plot.times[nearest]) - at)) nearest = index;
    });
    if (!plot.times.length) return;
    const column = frame.x(plot.times[nearest]);
    pen.strokeStyle = this._colour('--ink-soft');
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(column, MARGIN.top);
    pen.lineTo(column, HEIGHT - MARGIN.bottom);
    pen.stroke();
    const words = [plot.time(plot.times[nearest]), ...plot.lines.map((line) =>
      `${line.name} ${number(line.values[nearest], plot.digits ?? 2)}`)].join('   ');
    const half = pen.measureText(words).width / 2 + 8;
    const middle = Math.max(half, Math.min(this.canvas.clientWidth - half, column));
    pen.fillStyle = this._colour('--surface');
    pen.fillRect(middle - half, 0, 2 * half, 20);
    pen.fillStyle = this._colour('--ink');
    pen.textAlign = 'center';
    pen.fillText(words, middle, 10);
  }
}
