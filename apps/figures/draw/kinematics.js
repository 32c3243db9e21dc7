// Where rigid footwall and slip alone put the basin, as apps/measures/basin/kinematics.cpp has it: y up, metres, degrees.

/** Spacing of samples, m, as of kinematics.cpp: finer where the detachment is shorter than 5 km. */
function spacingOf(chain) { return Math.min(25, lengthOf(chain) / 200); }

function tangentAt(chain, arcLength) {
  const h = 1e-3, from = clamp(arcLength, 0, lengthOf(chain) - h), a = pointAt(chain, from), b = pointAt(chain, from + h);
  const length = Math.hypot(b.x - a.x, b.y - a.y);
  return {x: (b.x - a.x) / length, y: (b.y - a.y) / length};
}

/** Height of the detachment against u = x + depth tan(angle): where a shear plane meets it. */
class ShearCoordinate {
  constructor(chain, tangent) {
    const end = lengthOf(chain), spacing = spacingOf(chain);
    this.u = [];
    this.y = [];
    for (let s = 0; s <= end; s += spacing) {
      const p = pointAt(chain, s), u = p.x - p.y * tangent;
      if (!this.u.length || u > this.u.at(-1)) {
        this.u.push(u);
        this.y.push(p.y);
      }
    }
  }

  height(u) {
    if (u <= this.u[0]) return 0;
    let low = 0, high = this.u.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.u[middle] < u) low = middle + 1;
      else high = middle;
    }
    if (low === this.u.length) return this.y.at(-1);
    const share = (u - this.u[low - 1]) / (this.u[low] - this.u[low - 1]);
    return this.y[low - 1] + share * (this.y[low] - this.y[low - 1]);
  }
}

/** Top of a hanging wall that shears on planes inclined by an angle from the vertical (White et al. 1986), from its cutoff
 * to x = right. */
function inclinedShearTop(chain, extension, angle, right, fault = new ShearCoordinate(chain, Math.tan(angle * degree)), step = spacingOf(chain)) {
  const tangent = Math.tan(angle * degree), deepest = -pointAt(chain, lengthOf(chain)).y, top = [];
  for (let u = extension; u <= right + deepest * tangent; u += step) {
    const y = fault.height(u) - fault.height(u - extension), x = u + y * tangent;
    if (x > right && u > right) break;
    top.push({x, y});
  }
  return top;
}

/** What was flat at a depth before extension, in the same hanging wall. */
function inclinedShearLayer(extension, angle, right, fault, depth, step) {
  const tangent = Math.tan(angle * degree), line = [];
  for (let u = extension; u <= right + 2 * depth * Math.abs(tangent) + extension; u += step) {
    if (-depth < fault.height(u - extension)) continue; // in the footwall
    const y = fault.height(u) - fault.height(u - extension) - depth;
    const x = u + y * tangent;
    if (x > right) break;
    line.push({x, y});
  }
  return line;
}

/** Top of a hanging wall whose lines normal to the detachment stay normal (Braun et al. 1994). */
function normalsTop(chain, extension, right) {
  const end = lengthOf(chain), spacing = spacingOf(chain), top = [];
  for (let x = 0; x + extension <= right; x += spacing) {
    const foot = footPoint(chain, {x, y: 0}), s = foot ? foot.arcLength : 0, distance = foot ? foot.distance : x;
    if (s + extension > end) break;
    const p = pointAt(chain, s + extension), t = tangentAt(chain, s + extension);
    top.push({x: p.x - distance * t.y, y: p.y + distance * t.x});
  }
  return top;
}

/** Rotation of the head block: the dip at the breakaway less that one extension further down. */
function normalsTilt(chain, extension) {
  const a = tangentAt(chain, 0), b = tangentAt(chain, extension);
  return Math.atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y) / degree;
}

/** Whether some of the head block is still on its way to where the detachment dips least before it steepens again. */
function headBlockTurns(chain, extension) {
  const less = 0.5 * degree, steeper = 5 * degree, dip = t => Math.atan2(-t.y, t.x);
  let at = 0, end = 0, least = dip(chain[0].startTangent);
  const take = t => {
    if (dip(t) < least - less) [least, end] = [dip(t), at];
    return dip(t) < least + steeper;
  };
  for (const s of chain) {
    if (!take(s.startTangent)) break;
    at += s.length;
    if (!take(s.endTangent)) break;
  }
  return end === 0 || extension <= end;
}

/** Tilt, cutoff and basin of a chain at an extension. */
function predictKinematics(chain, extension, angle, right, fault = new ShearCoordinate(chain, Math.tan(angle * degree))) {
  const cutoff = pointAt(chain, extension), top = inclinedShearTop(chain, extension, angle, right, fault);
  const deepest = top.reduce((low, p) => p.y < low.y ? p : low, {x: 0, y: 0});
  return {tilt: headBlockTurns(chain, extension) ? normalsTilt(chain, extension) : null,
    cutoff: extension <= lengthOf(chain) ? {x: cutoff.x, depth: -cutoff.y} : null,
    area: extension * -pointAt(chain, lengthOf(chain)).y, deepest: {x: deepest.x, depth: -deepest.y}};
}
