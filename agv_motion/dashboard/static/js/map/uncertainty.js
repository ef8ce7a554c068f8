/** Ellipses are drawn at two standard deviations. */
const SIGMAS = 2;

/** The ellipse within which it stands, and the wedge within which it looks. */
export function drawUncertainty(/** @type {import('./map.js').Scene} */ { context, view, palette },
  /** @type {any} */ pose) {
  const [xx, xy, yy, tt] = pose.covariance ?? [];
  if (![xx, xy, yy].every((value) => Number.isFinite(value)) || !(xx + yy > 0)) return;
  const mean = (xx + yy) / 2;
  const spread = Math.hypot((xx - yy) / 2, xy);
  const [long, short] = [mean + spread, mean - spread].map((value) => SIGMAS * Math.sqrt(Math.max(0, value)));
  view.useMetres(context);
  context.beginPath();
  context.ellipse(pose.x, pose.y, Math.min(long, 1e4), Math.min(short, 1e4), 0.5 * Math.atan2(2 * xy, xx - yy), 0, 2 * Math.PI);
  context.strokeStyle = palette.colour('robot');
  context.lineWidth = view.pixels(1.2);
  context.setLineDash([view.pixels(4), view.pixels(3)]);
  context.stroke();
  context.setLineDash([]);
  if (Number.isFinite(tt) && tt > 0) {
    const wedge = Math.min(Math.PI, SIGMAS * Math.sqrt(tt));
    const reach = view.pixels(60);
    context.beginPath();
    context.moveTo(pose.x, pose.y);
    context.arc(pose.x, pose.y, reach, pose.heading - wedge, pose.heading + wedge);
    context.closePath();
    context.fillStyle = palette.colour('robot');
    context.globalAlpha = 0.1;
    context.fill();
    context.globalAlpha = 1;
  }
}
