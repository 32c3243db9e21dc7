// Clicks, drags, fingers and wheel on a section, and what is said beside the pointer.

/** Clicks, drags and wheel on one section. */
function listenTo(section) {
  const canvas = section.lineCanvas;
  let from = null, moved = false;
  const fingers = new Map();   // places of pointers that are down, by their numbers
  const at = event => {
    const box = canvas.getBoundingClientRect();
    return [(event.clientX - box.left) * canvas.width / box.width, (event.clientY - box.top) * canvas.height / box.height];
  };
  canvas.addEventListener("pointerdown", event => {
    fingers.set(event.pointerId, at(event));
    from = at(event);
    moved = fingers.size > 1;
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", event => {
    if (fingers.size === 2 && fingers.has(event.pointerId)) return pinch(fingers, event.pointerId, at(event));
    if (!from) return readOut(section, ...at(event));
    const [column, row] = at(event), {view} = page;
    if (Math.hypot(column - from[0], row - from[1]) < 4 && !moved) return;
    moved = true;
    if ($("measure").checked) return measureLine(section, from, [column, row]);
    view.left -= (column - from[0]) / view.scale;
    view.top -= (row - from[1]) / view.scale / view.height;
    from = [column, row];
    draw().catch(trouble);
  });
  const lift = event => {
    fingers.delete(event.pointerId);
    const place = from;
    from = fingers.size ? [...fingers.values()][0] : null;   // the finger that stays goes on to drag
    return fingers.size ? null : place;
  };
  canvas.addEventListener("pointercancel", lift);
  canvas.addEventListener("pointerup", async event => {
    const place = lift(event);
    if (moved || !place) return;
    const run = section.run, k = momentOf(run);
    const index = page.shown.has("faults") ? await section.faultAt(k, page.view, ...place, 6 * section.ratio) : -1;
    const id = section.painter.ownerAt(...place);
    pick(index >= 0 && !event.shiftKey ? {kind: "fault", run, index} : id !== nobody ? {kind: "disc", run, id} : null);
  });
  canvas.addEventListener("pointerleave", () => { section.readout.hidden = true; });
  canvas.addEventListener("dblclick", whole);
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    zoom(event.deltaY < 0 ? 1.25 : 0.8, ...at(event));
  }, {passive: false});
}

/** Two fingers: the section grows as they part, and what is between them goes with them. */
function pinch(fingers, moving, to) {
  const [still] = [...fingers].filter(([number]) => number !== moving).map(([, place]) => place), before = fingers.get(moving), {view} = page;
  const middle = place => [(place[0] + still[0]) / 2, (place[1] + still[1]) / 2], apart = place => Math.hypot(place[0] - still[0], place[1] - still[1]);
  const [old, now] = [middle(before), middle(to)];
  view.left -= (now[0] - old[0]) / view.scale;
  view.top -= (now[1] - old[1]) / view.scale / view.height;
  fingers.set(moving, to);
  zoom(apart(to) / Math.max(apart(before), 1), ...now);
}

/** Says beside the pointer where it is and what is there. */
function readOut(section, column, row) {
  const {run, readout} = section, k = momentOf(run), [x, depth] = section.toMetres(page.view, column, row);
  const id = section.painter.ownerAt(column, row), mode = modes[page.mode], words = [`x ${placeText(x)}, ${placeText(depth)} deep`];
  if (id !== nobody) {
    const stratum = run.codes[k].stratum[id];
    const from = !stratum && run.codes[k].start_depth_m ? `, from ${placeText(run.values(k, "start_depth_m")[id], 1)}` : "";
    const layer = run.codes[k].layer && run.codes[k].layer[id];
    words.push(stratum ? stratumName(stratum) : layer ? `${run.head.rock_layers[layer - 1]}${from}` : `pre-rift${from}`);
    const isRead = mode.needs.every(name => run.codes[k][name]);
    if (page.mode === "rock" && isRead) words.push(vocabulary.rock_classes[run.codes[k].behaviour[id]].label);
    else if (mode.end && isRead) {
      const value = page.mode === "displacement" ? displacement(run, k)[id] : run.values(k, mode.needs[0])[id];
      words.push(`${modeLabel(page.mode, page.runs).replace(/ \(.*/, "")} ${Number.isNaN(value) ? "not defined" : digits(value / (mode.unit || 1), 2) +
        (mode.unit ? " MPa" : page.mode === "displacement" ? " m" : "")}`);
    }
  }
  readout.textContent = words.join("; ");
  readout.hidden = false;
  const place = column / section.ratio, width = section.host.clientWidth;
  readout.style.left = place < width / 2 ? `${place + 14}px` : "auto";
  readout.style.right = place < width / 2 ? "auto" : `${width - place + 14}px`;
  readout.style.top = `${Math.min(row / section.ratio + 14, section.host.clientHeight - 30)}px`;
}

/** Length and dip of a line that is dragged. */
async function measureLine(section, from, to) {
  const [x0, z0] = section.toMetres(page.view, ...from), [x1, z1] = section.toMetres(page.view, ...to);
  await section.draw(momentOf(section.run), page.view, page.shown, page.picked, null);
  section.line(page.view, [[x0, z0], [x1, z1]], pickedInk, 2);
  const dip = Math.atan2(Math.abs(z1 - z0), Math.abs(x1 - x0)) * 180 / Math.PI;
  page.picked = {kind: "line", run: section.run, text: `Measured: ${metresText(Math.hypot(x1 - x0, z1 - z0))}, dip ` +
    `${dip.toFixed(1)}°, ${metresText(Math.abs(x1 - x0))} across, ${metresText(Math.abs(z1 - z0))} down`};
  describe();
}
