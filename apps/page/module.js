'use strict';
// The module listric.wasm for a page, a worker or node: functions that take and give texts.

/// What WASI asks a system for, as far as the module has one: a clock, neither files nor an environment; what goes to
/// standard error is told. `memory()` is the module's, of which `textAt(at, size)` reads a text.
function systemOf(memory, textAt, tell) {
  const notThere = 44, badFile = 8; // of WASI
  const view = () => new DataView(memory());
  return {
    clock_time_get(id, precision, at) {
      const nanoseconds = id === 0 ? 1e6 * Date.now() : 1e6 * performance.now();
      view().setBigUint64(at, BigInt(Math.round(nanoseconds)), true);
      return 0;
    },
    environ_sizes_get(count, size) {
      view().setUint32(count, 0, true);
      view().setUint32(size, 0, true);
      return 0;
    },
    environ_get: () => 0,
    fd_write(file, list, count, written) {
      let text = '', size = 0;
      for (let k = 0; k < count; ++k) {
        const part = view().getUint32(list + 8 * k + 4, true);
        text += textAt(view().getUint32(list + 8 * k, true), part);
        size += part;
      }
      view().setUint32(written, size, true);
      tell(true, text);
      return 0;
    },
    // One folder, /, in which nothing is there: without it, nothing would be allowed instead.
    fd_prestat_get(file, at) {
      if (file !== 3) return badFile;
      view().setUint32(at, 0, true);
      view().setUint32(at + 4, 1, true);
      return 0;
    },
    fd_prestat_dir_name(file, at) {
      view().setUint8(at, 47);
      return 0;
    },
    path_open: () => notThere,
    path_filestat_get: () => notThere,
    proc_exit(code) { throw new Error(`the module ended, ${code}`); },
  };
}

/// Starts a module. `tell(isWarning, text)` is called for messages while it works, `keep(path, bytes)` for files of a
/// run after keepFiles().
async function startModule(bytes, tell, keep) {
  let memory = null;
  const textAt = (at, size) => new TextDecoder().decode(new Uint8Array(memory.buffer, at, size));
  const noSuchCall = 52; // of WASI
  const system = systemOf(() => memory.buffer, textAt, tell);
  const wasi = new Proxy(system, {get: (known, name) => known[name] || (() => noSuchCall)});
  const listric = {
    tell: (isWarning, at, size) => tell(Boolean(isWarning), textAt(at, size)),
    keep: (path, letters, at, size) => keep(textAt(path, letters), new Uint8Array(memory.buffer, at, size).slice()),
  };
  const imports = {listric};
  const module = await WebAssembly.compile(bytes);
  for (const {module: from, name} of WebAssembly.Module.imports(module))
    if (from !== 'listric')
      (imports[from] ||= {})[name] = wasi[name];
  const {exports} = await WebAssembly.instantiate(module, imports);
  memory = exports.memory;
  exports._initialize();

  // A call may move the memory: its buffer is asked for afterwards.
  const put = bytes => {
    const at = exports.input(bytes.length);
    new Uint8Array(memory.buffer, at, bytes.length).set(bytes);
  };
  const call = (name, ...values) => {
    const done = exports[name](...values);
    const text = textAt(exports.result(), exports.result_size());
    if (!done)
      throw new Error(text);
    return JSON.parse(text);
  };
  /// What a function of page.cpp answers to what it is given as JSON.
  const ask = (name, value) => {
    put(new TextEncoder().encode(JSON.stringify(value)));
    return call(name);
  };
  return {
    memory: () => memory.buffer.byteLength,
    program: () => call('program'),
    /// Gives a text in place of a file.
    give(path, text) {
      const name = new TextEncoder().encode(path), content = new TextEncoder().encode(text);
      const both = new Uint8Array(name.length + content.length);
      both.set(name);
      both.set(content, name.length);
      put(both);
      exports.give(name.length);
    },
    ask,
    /// Reads a scene: {scene, accuracy, seed, set}.
    read: request => ask('read', request),
    begin: () => call('begin'),
    extend: (goal, seconds) => call('extend', goal, seconds),
    keepFiles: () => call('keep_files'),
    close: () => call('close'),
    /// x, y, radius, stratum, strain and depth at the start of each disc.
    discs(count) {
      const at = exports.discs();
      return new Float32Array(memory.buffer, at, 6 * count).slice();
    },
  };
}
