// A zip of files that come one by one: each is compressed as it comes; a later one takes the place of one of its path.

const crcTable = Uint32Array.from({length: 256}, (_, n) => {
  for (let bit = 0; bit < 8; ++bit) n = n & 1 ? 0xedb88320 ^ n >>> 1 : n >>> 1;
  return n;
});

function crcOf(bytes) {
  let crc = -1;
  for (const byte of bytes) crc = crcTable[(crc ^ byte) & 255] ^ crc >>> 8;
  return ~crc >>> 0;
}

/** Numbers as bytes, each with its size: [number, 2], [number, 4]. */
function littleEndian(...numbers) {
  const bytesOf = ([number, size]) => Array.from({length: size}, (_, k) => number >>> 8 * k & 255);
  return Uint8Array.from(numbers.flatMap(bytesOf));
}

/** Bytes compressed, if the browser can, and the number of the method. */
async function deflated(bytes) {
  const whole = new Blob([bytes]);
  let stream = null;
  try { stream = new CompressionStream("deflate-raw"); } catch { return {method: 0, blob: whole}; } // before 2023
  return {method: 8, blob: await new Response(whole.stream().pipeThrough(stream)).blob()};
}

class Zip {
  entries = new Map();

  add(path, bytes) {
    const crc = crcOf(bytes), size = bytes.length;
    this.entries.set(path, deflated(bytes).then(packed => ({crc, size, ...packed})));
  }

  /** The file, in which all lies in one folder. */
  async blob(folder) {
    const parts = [], directory = [], now = new Date();
    const time = [now.getHours() << 11 | now.getMinutes() << 5 | now.getSeconds() >> 1, 2];
    const date = [now.getFullYear() - 1980 << 9 | now.getMonth() + 1 << 5 | now.getDate(), 2];
    let at = 0, length = 0;
    for (const [path, packing] of this.entries) {
      const {crc, size, method, blob} = await packing, name = new TextEncoder().encode(`${folder}/${path}`);
      const common = [[20, 2], [0x0800, 2], [method, 2], time, date, [crc, 4], [blob.size, 4], [size, 4],
        [name.length, 2], [0, 2]];
      const local = littleEndian([0x04034b50, 4], ...common);
      const central = littleEndian([0x02014b50, 4], [20, 2], ...common, [0, 2], [0, 2], [0, 2], [0, 4], [at, 4]);
      parts.push(local, name, blob);
      directory.push(central, name);
      at += local.length + name.length + blob.size;
      length += central.length + name.length;
    }
    if (at + length >= 2 ** 32)
      throw new Error("the run has more than 4 GB, which no zip holds; run it with the program");
    const count = [this.entries.size, 2];
    const end = littleEndian([0x06054b50, 4], [0, 4], count, count, [length, 4], [at, 4], [0, 2]);
    return new Blob([...parts, ...directory, end], {type: "application/zip"});
  }
}
