// Fills discs row by row into an image, and their ids into a map of the same size: what is clicked.

const nobody = -1;

/** A view of the section: left and top edge (m), pixels per metre, exaggeration of heights. */
class Painter {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
  }

  resize(width, height) {
    this.canvas.width = width;
    this.canvas.height = height;
    this.image = this.context.createImageData(width, height);
    this.pixels = new Uint32Array(this.image.data.buffer);
    this.owner = new Int32Array(width * height);
  }

  /** Discs in increasing id; x, depth and radius in metres, colours by id. */
  paint(view, discs, colours) {
    const {width, height} = this.canvas, {present, x, depth, radius} = discs;
    this.pixels.fill(0);
    this.owner.fill(nobody);
    for (let id = 0; id < present.length; ++id) {
      if (!present[id]) continue;
      const across = radius[id] * view.scale, up = across * view.height;
      const cx = (x[id] - view.left) * view.scale, cy = (depth[id] - view.top) * view.scale * view.height;
      if (cx + across < 0 || cx - across > width || cy + up < 0 || cy - up > height) continue;
      const colour = colours[id];
      const first = Math.max(Math.ceil(cy - up - 0.5), 0), end = Math.min(Math.floor(cy + up - 0.5), height - 1);
      for (let row = first; row <= end; ++row) {
        const dy = (row + 0.5 - cy) / up, half = across * Math.sqrt(Math.max(1 - dy * dy, 0));
        const from = row * width + Math.max(Math.round(cx - half), 0);
        const to = row * width + Math.min(Math.round(cx + half), width);
        for (let at = from; at < to; ++at) {
          this.pixels[at] = colour;
          this.owner[at] = id;
        }
      }
    }
    this.context.putImageData(this.image, 0, 0);
  }

  ownerAt(column, row) {
    const {width, height} = this.canvas;
    return column < 0 || row < 0 || column >= width || row >= height
      ? nobody : this.owner[Math.floor(row) * width + Math.floor(column)];
  }
}
