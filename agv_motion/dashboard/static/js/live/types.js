/**
 * Shapes of what the server sends. SI units, radians, frame `map` unless it says `body`.
 * A number that is missing is null.
 *
 * @typedef {[number, number]} Point
 * @typedef {{kind: 'hello', role: Role, csrf: string, robots: string[], now: number,
 *   user?: string|null}} Hello
 * @typedef {'public'|'viewer'|'operator'|'expert'} Role
 * @typedef {{robot: string, topic: string, at: number, value: any}} Update
 * @typedef {{kind: 'frame', n: number, now: number, updates: Update[]}} Frame
 * @typedef {{kind: 'outcome', id: string, robot: string, action: string,
 *   state: 'sent'|'done'|'refused'|'no_answer', text: string}} Outcome
 *
 * @typedef {{kind: string, colour: 'green'|'yellow'|'red', word: string, sentence: string,
 *   moving: boolean, stopped: boolean, standstill: boolean, driver: string,
 *   since: number|null}} Summary
 * @typedef {{x: number, y: number, heading: number, covariance?: number[]}} Pose
 * @typedef {{kind: string, outline?: Point[], radius?: number, turrets?: Point[],
 *   wheels?: {x: number, y: number, angle: number}[], wheel_radius?: number,
 *   max_speed?: number, max_turn?: number}} Platform
 * @typedef {{angles?: number[], speeds: number[],
 *   commanded?: {angles?: number[], speeds: number[]}}} WheelState
 * @typedef {{vx: number, vy: number, wz: number, icr: Point|null}} Twist
 * @typedef {{boundary: Point[], holes: Point[][], translation_only: Point[][], margin: number,
 *   clearance_from: string, home: Point|null}} Zone
 * @typedef {{x: number, y: number, resolution: number, width: number, height: number,
 *   cells: string}} Grid
 * @typedef {{value: number, low: number, high: number}} Litres with the 95 % interval
 * @typedef {{hours: number|null, litres: Litres|null}} Drank today
 */
export {};
