'use strict';
// A worker of a page, after module.js in its text. In: {load: bytes of the module}, then {check: {files, request,
// number}}, or {start: {files, request}} and while it runs {stop: true} and {goOn: true}. Out: {program}; {read} or
// {failed}, of a check with its number; of a run {progress}, {radius}, {file, bytes}, {moment, discs}, {travel},
// {stopped}, and in the end {done, summary, verdict}.

const slice = 0.25;           // seconds of a run between messages that are heard
const picturesOfRun = 100;
let module = null, isStopped = false, wake = null;

onmessage = ({data}) => {
  const failed = error => postMessage({failed: reasonOf(error), number: data.check?.number});
  const tell = (isWarning, text) => postMessage(isWarning ? {warning: text} : {progress: text});
  if (data.load) {
    module = startModule(data.load, tell, (file, bytes) => postMessage({file, bytes}, [bytes.buffer]));
    module.then(model => postMessage({program: model.program()})).catch(failed);
  }
  if (data.check)
    module.then(model => postMessage({read: readScene(model, data.check), number: data.check.number})).catch(failed);
  if (data.start) module.then(model => run(model, data.start)).catch(failed);
  if (data.stop) isStopped = true;
  if (data.goOn) {
    isStopped = false;
    if (wake) wake();
  }
};

/** What has gone wrong; what the browser says of its own limits is no help alone. */
function reasonOf(error) {
  return error instanceof RangeError || error instanceof WebAssembly.RuntimeError
    ? `the browser lets the model do no more (${error.message}), mostly for want of memory: take larger discs, or ` +
      'run it with the program'
    : error.message;
}

function readScene(model, {files, request}) {
  for (const [path, text] of Object.entries(files)) model.give(path, text);
  return model.read(request);
}

/** Lets messages in; where one asks for a stop, until another asks to go on. */
async function listen() {
  await new Promise(done => setTimeout(done));
  if (!isStopped) return;
  postMessage({stopped: true});
  await new Promise(done => { wake = done; });
  wake = null;
}

async function run(model, asked) {
  const scene = readScene(model, asked);
  postMessage({read: scene});
  let now = model.begin();
  const show = () => {
    const discs = model.discs(now.discs);
    postMessage({moment: now, memory: model.memory(), discs}, [discs.buffer]);
  };
  postMessage({radius: model.keepFiles().mean_radius_m});
  show();
  for (let k = 1; k <= picturesOfRun; ++k) {
    do {
      now = model.extend(scene.distance_m * k / picturesOfRun, slice);
      postMessage({travel: now.travel});
      await listen();
    } while (!now.arrived);
    show();
  }
  postMessage({done: now, ...model.close()});
}
