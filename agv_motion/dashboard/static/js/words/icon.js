const SVG = 'http://www.w3.org/2000/svg';

/** Lines on a square of 24, drawn here so that no font need have them. */
const PATHS = {
  plus: 'M12 5v14M5 12h14',
  minus: 'M5 12h14',
  fit: 'M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5',
  layers: 'M12 4l9 5-9 5-9-5zM3 14l9 5 9-5',
  play: 'M8 5l11 7-11 7z',
  pause: 'M8 5v14M16 5v14',
  before: 'M6 5v14M19 5L9 12l10 7z',
  after: 'M18 5v14M5 5l10 7-10 7z',
  save: 'M12 4v11M7 11l5 5 5-5M5 20h14',
  mark: 'M7 3v18M7 4h11l-3 4 3 4H7',
};

/**
 * @param {keyof PATHS} name
 * @returns {SVGElement}
 */
export function icon(name) {
  const picture = document.createElementNS(SVG, 'svg');
  picture.setAttribute('viewBox', '0 0 24 24');
  picture.setAttribute('class', 'icon');
  picture.setAttribute('aria-hidden', 'true');
  const path = document.createElementNS(SVG, 'path');
  path.setAttribute('d', PATHS[name]);
  picture.append(path);
  return picture;
}
