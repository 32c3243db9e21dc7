'use strict';
// node run.js listric.wasm SCENE METRES [ACCURACY [FOLDER]]: runs a shipped scene in the module, prints its state hash,
// and leaves the run's files in a folder, if one is named.

const fs = require('fs');
const path = require('path');

const apps = path.dirname(__dirname);
const startModule = new Function(`${fs.readFileSync(path.join(__dirname, 'module.js'))}; return startModule;`)();

async function run(file, name, metres, accuracy = 'draft', output = '') {
  const keep = (file, bytes) => {
    fs.mkdirSync(path.join(output, path.dirname(file)), {recursive: true});
    fs.writeFileSync(path.join(output, file), bytes);
  };
  const module = await startModule(fs.readFileSync(file), (isWarning, text) => isWarning && console.error(text), keep);
  for (const folder of ['materials', 'scenes', 'records'])
    for (const one of fs.readdirSync(path.join(apps, folder)))
      module.give(`/listric/${folder}/${one}`, fs.readFileSync(path.join(apps, folder, one), 'utf8'));
  const scene = module.read({scene: name, accuracy});
  const goal = Math.min(Number(metres), scene.distance_m);
  module.begin();
  if (output)
    module.keepFiles();
  let now;
  do
    now = module.extend(goal, 1.0);
  while (!now.arrived);
  if (output)
    module.close();
  console.log(now.state_hash);
  const {user} = process.cpuUsage();
  console.error(`${name} to ${metres} m: ${now.discs} discs, ${(user / 1e6).toFixed(1)} s, ` +
    `${(module.memory() / 2 ** 20).toFixed(1)} MiB`);
}

run(...process.argv.slice(2)).catch(error => {
  console.error(error.message);
  process.exit(1);
});
