// The detachment under the hand: a chain of arcs and lines from the breakaway at the origin, y up, metres, and what dragging,
// adding and removing its nodes makes of it.

const degree = Math.PI / 180;
const leastTurn = 0.5;      // of an arc, degrees
const largestRadius = 1e6;  // that a hand makes, m

const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/** {startDip, pieces} of a scene's [detachment]; null: it has none, or none that can be drawn. */
function shapeOf(table) {
  const isPiece = segment => Object.entries(segment || {}).every(([kind, given], k) => k === 0 && (kind === "arc" || kind === "line") &&
    typeof given === "object" && Number(given.radius_m ?? given.length_m) > 0) && Object.keys(segment || {}).length === 1;
  if (!table || !Array.isArray(table.segments) || !table.segments.length || !table.segments.every(isPiece)) return null;
  return {startDip: Number(table.start_dip_deg ?? 90), pieces: table.segments.map(segment => {
    const [[kind, given]] = Object.entries(segment);
    const piece = kind === "arc" ? {kind, radius: Number(given.radius_m), endDip: Number(given.end_dip_deg ?? 0)}
      : {kind, length: Number(given.length_m)};
    if ("start_dip_deg" in given) piece.startDip = Number(given.start_dip_deg);
    return piece;
  })};
}

/** The keys of [detachment] that hold a shape. */
function tableOf(shape) {
  return {start_dip_deg: shape.startDip, segments: shape.pieces.map(piece => {
    const kink = "startDip" in piece ? {start_dip_deg: piece.startDip} : {};
    return piece.kind === "arc" ? {arc: {radius_m: piece.radius, end_dip_deg: piece.endDip, ...kink}}
      : {line: {length_m: piece.length, ...kink}};
  })};
}

function copyOf(shape) { return {startDip: shape.startDip, pieces: shape.pieces.map(piece => ({...piece}))}; }

/** A point of a segment, so far along it. */
function pointOn({start, startDip, curvature}, way) {
  const from = -startDip * degree, to = from + way * curvature;
  if (curvature === 0) return {x: start.x + way * Math.cos(from), y: start.y + way * Math.sin(from)};
  return {x: start.x + (Math.sin(to) - Math.sin(from)) / curvature, y: start.y - (Math.cos(to) - Math.cos(from)) / curvature};
}

/** Segments end to end, continued by a flat to x = reach: {start, end, startDip, endDip, length, curvature}. */
function chainOf(shape, reach = 0) {
  const chain = [], add = (startDip, endDip, length, curvature) => {
    const segment = {start: chain.at(-1)?.end ?? {x: 0, y: 0}, startDip, endDip, length, curvature};
    chain.push({...segment, end: pointOn(segment, length)});
  };
  let dip = shape.startDip;
  for (const piece of shape.pieces) {
    dip = piece.startDip ?? dip;
    const turn = piece.kind === "arc" ? (dip - piece.endDip) * degree : 0;
    add(dip, piece.endDip ?? dip, piece.length ?? piece.radius * Math.abs(turn), Math.sign(turn) / (piece.radius ?? 1));
    dip = chain.at(-1).endDip;
  }
  const {x} = chain.at(-1).end;
  if (x < reach) add(0, 0, reach - x, 0);
  return chain;
}

/** The point of a chain at an arc length. */
function pointAt(chain, way) {
  let k = 0;
  while (k + 1 < chain.length && way > chain[k].length) way -= chain[k++].length;
  return pointOn(chain[k], way);
}

/** The unit vector in which a segment begins. */
function tangentOf({startDip}) { return {x: Math.cos(startDip * degree), y: -Math.sin(startDip * degree)}; }

/** Depth of the flat, m. */
function depthOf(shape) { return -chainOf(shape).at(-1).end.y; }

// -- rules that hold after every change

/** The last piece that is no line at a dip of 0: it ends where the detachment soles out. */
function lastSloping(shape) {
  const chain = chainOf(shape);
  for (let k = chain.length - 1; k >= 0; --k)
    if (chain[k].startDip !== 0 || chain[k].endDip !== 0) return k;
  return 0;
}

/** Whether a hand may make a shape: every arc turns, and the last piece ends flat. */
function isWhole(shape) {
  const chain = chainOf(shape);
  return chain[shape.pieces.length - 1].endDip === 0 && shape.pieces.every(({kind}, k) => kind === "line" || chain[k].startDip !== chain[k].endDip);
}

/** Bounds of the dip at which piece k ends, so that the next arc, and piece k itself, keep the way in which they turn. */
function dipBounds(shape, k) {
  const chain = chainOf(shape), own = shape.pieces[k];
  let low = 0, high = 90;
  if (own?.kind === "arc")
    if (chain[k].startDip > own.endDip) high = Math.min(high, chain[k].startDip - leastTurn);
    else low = Math.max(low, chain[k].startDip + leastTurn);
  for (let n = k + 1; n < shape.pieces.length && !("startDip" in shape.pieces[n]); ++n) {
    if (shape.pieces[n].kind !== "arc") continue;
    if (chain[n].startDip > shape.pieces[n].endDip) low = Math.max(low, shape.pieces[n].endDip + leastTurn);
    else high = Math.min(high, shape.pieces[n].endDip - leastTurn);
    break;
  }
  return [clamp(Math.min(low, high), 0, 90), clamp(high, 0, 90)];
}

const roundDip = dip => Number(dip.toFixed(2));

/** Decimals of lengths, m, that a hand makes in a section of a length: none in a basin, more in a smaller model. */
function decimalsIn(length) { return clamp(Math.ceil(Math.log10(1e4 / length)), 0, 9); }

/** The same of a shape: by its longest piece. */
function decimalsOf(shape) { return decimalsIn(Math.max(...shape.pieces.map(piece => piece.radius ?? piece.length))); }

/** Least length of a line and radius of an arc, m: 10 m in a basin, never less than the program takes. */
function leastLengthOf(shape) { return Math.max(10 ** (1 - decimalsOf(shape)), 1e-3); }

const roundLength = (length, decimals) => Number(length.toFixed(decimals));

/** Gives the last arc the radius with which the detachment soles out at a depth; false: there is no such radius. */
function setDepth(shape, depth) {
  for (let k = shape.pieces.length - 1; k >= 0; --k) {
    if (shape.pieces[k].kind !== "arc") continue;
    const segment = chainOf(shape)[k], drop = Math.cos(segment.endDip * degree) - Math.cos(segment.startDip * degree);
    const radius = shape.pieces[k].radius + (depth - depthOf(shape)) / drop;
    if (!(radius >= leastLengthOf(shape) && radius <= largestRadius)) return false;
    shape.pieces[k].radius = roundLength(radius, 2 + decimalsOf(shape));
    return true;
  }
  return false;
}

// -- changes, each of which returns another shape

/** The detachment after its node k (the end of piece k) has been dragged toward a point. */
function dragNode(shape, k, target) {
  const next = copyOf(shape), piece = next.pieces[k], segment = chainOf(shape)[k];
  if (piece.kind === "arc") dragArcEnd(next, k, segment, target, k === lastSloping(shape));
  else dragLineEnd(next, k, segment, target);
  return next;
}

function dragArcEnd(shape, k, segment, target, isLast) {
  const piece = shape.pieces[k], t = tangentOf(segment), a = segment.startDip, least = leastLengthOf(shape);
  const d = {x: target.x - segment.start.x, y: target.y - segment.start.y};
  let endDip = piece.endDip;
  if (!isLast) {
    const along = Math.max(d.x * t.x + d.y * t.y, least);
    endDip = roundDip(clamp(a - 2 * Math.atan2(t.x * d.y - t.y * d.x, along) / degree, ...dipBounds(shape, k)));
  }
  // The chord from the arc's start dips by the mean of the dips at its ends.
  const chord = 0.5 * (a + endDip) * degree, length = d.x * Math.cos(chord) - d.y * Math.sin(chord);
  piece.endDip = endDip;
  piece.radius = roundLength(clamp(length / (2 * Math.sin(0.5 * Math.abs(a - endDip) * degree)), least, largestRadius), decimalsOf(shape));
}

function dragLineEnd(shape, k, segment, target) {
  const piece = shape.pieces[k], before = shape.pieces[k - 1], isFlat = k > lastSloping(shape);
  const least = leastLengthOf(shape), decimals = decimalsOf(shape);
  const project = (start, dip) => roundLength(Math.max((target.x - start.x) * Math.cos(dip * degree) -
    (target.y - start.y) * Math.sin(dip * degree), least), decimals);
  if (!isFlat && (k === 0 || "startDip" in piece)) {
    const dip = roundDip(clamp(-Math.atan2(target.y - segment.start.y, target.x - segment.start.x) / degree, ...dipBounds(shape, k)));
    if (k === 0) shape.startDip = dip;
    if (k > 0 || "startDip" in piece) piece.startDip = dip;
    piece.length = project(segment.start, dip);
  } else if (!isFlat && before.kind === "arc") {
    before.endDip = roundDip(clamp(tangentDip(chainOf(shape)[k - 1], before.radius, target) ?? before.endDip, ...lineBounds(shape, k)));
    piece.length = project(chainOf(shape)[k].start, before.endDip);
  } else {
    piece.length = project(segment.start, segment.startDip);
  }
}

/** Bounds of the dip of line k, which the arc before it ends with. */
function lineBounds(shape, k) {
  const [low, high] = dipBounds(shape, k - 1), after = dipBounds(shape, k);
  return [Math.max(low, after[0]), Math.min(high, after[1])];
}

/** Dip at which a line leaves an arc's circle to reach a point; undefined: the point is within the circle. */
function tangentDip(segment, radius, target) {
  const side = Math.sign(segment.curvature), t = tangentOf(segment);
  const c = {x: segment.start.x - side * radius * t.y, y: segment.start.y + side * radius * t.x};
  const d = {x: target.x - c.x, y: target.y - c.y}, square = d.x * d.x + d.y * d.y - radius * radius;
  if (square <= 0) return undefined;
  const radial = Math.atan2(d.y, d.x) - side * Math.atan2(Math.sqrt(square), radius);
  const direction = radial + side * Math.PI / 2;
  return -Math.atan2(Math.sin(direction), Math.cos(direction)) / degree;
}

/** The detachment with another dip at the breakaway, or at a kink at the start of piece k. */
function turnStart(shape, dip, k = 0) {
  const next = copyOf(shape), piece = next.pieces[k];
  let low = 0, high = 90;
  for (let n = k; n < next.pieces.length && (n === k || !("startDip" in next.pieces[n])); ++n) {
    if (next.pieces[n].kind !== "arc") continue;
    if (chainOf(shape)[n].startDip > next.pieces[n].endDip) low = next.pieces[n].endDip + leastTurn;
    else high = next.pieces[n].endDip - leastTurn;
    break;
  }
  const value = roundDip(clamp(dip, clamp(low, 0, 90), clamp(high, 0, 90)));
  if (k === 0) next.startDip = value;
  if ("startDip" in piece) piece.startDip = value;
  return next;
}

/** The detachment with a node more on piece k: an arc becomes two of its radius, a line gets a ramp of two arcs. */
function addNode(shape, k, share = 0.5) {
  const next = copyOf(shape), piece = next.pieces[k], segment = chainOf(shape)[k], kink = "startDip" in piece ? {startDip: piece.startDip} : {};
  if (piece.kind === "arc") {
    const middle = roundDip(segment.startDip + clamp(share, 0.05, 0.95) * (segment.endDip - segment.startDip));
    if (Math.abs(segment.startDip - middle) < leastTurn || Math.abs(middle - segment.endDip) < leastTurn) return null;
    next.pieces.splice(k, 1, {kind: "arc", radius: piece.radius, endDip: middle, ...kink},
      {kind: "arc", radius: piece.radius, endDip: piece.endDip});
    return next;
  }
  const dip = segment.startDip, turn = dip > 80 ? -10 : 10, sine = Math.sin(10 * degree);
  const least = leastLengthOf(shape), round = length => roundLength(length, decimalsOf(shape));
  const radius = round(Math.min(5000, 0.15 * piece.length / sine)), width = 2 * radius * sine;
  const first = round(clamp(share * piece.length - 0.5 * width, least, piece.length - width - least));
  if (radius < least || !(first >= least)) return null;
  next.pieces.splice(k, 1, {kind: "line", length: first, ...kink}, {kind: "arc", radius, endDip: dip + turn},
    {kind: "arc", radius, endDip: dip}, {kind: "line", length: Math.max(round(piece.length - width - first), least)});
  return next;
}

/** The detachment without node k: piece k goes, and a neighbouring arc takes over where it led. null: it cannot be. */
function removeNode(shape, k) {
  const next = copyOf(shape), depth = depthOf(shape), chain = chainOf(shape), [gone] = next.pieces.splice(k, 1);
  if (!next.pieces.length) return null;
  if ("startDip" in gone && next.pieces[k] && !("startDip" in next.pieces[k]) && k > 0) next.pieces[k].startDip = gone.startDip;
  if (gone.kind === "arc") {
    const before = next.pieces[k - 1], after = next.pieces[k];
    if (after?.kind !== "arc" && before?.kind === "arc" && !(after && "startDip" in after)) before.endDip = gone.endDip;
    if (after?.kind === "arc" && after.endDip === chain[k].startDip && !("startDip" in after)) next.pieces.splice(k, 1);
    if (before?.kind === "arc" && before.endDip === (chain[k - 1].startDip)) next.pieces.splice(k - 1, 1);
  }
  for (let n = next.pieces.length - 1; n > 0; --n)
    if (next.pieces[n].kind === "line" && next.pieces[n - 1].kind === "line" && !("startDip" in next.pieces[n])) {
      next.pieces[n - 1].length += next.pieces[n].length;
      next.pieces.splice(n, 1);
    }
  if (!next.pieces.length || !isWhole(next) || !(depthOf(next) >= leastLengthOf(next))) return null;
  setDepth(next, depth);
  return next;
}
