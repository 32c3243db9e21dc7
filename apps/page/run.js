'use strict';
// node run.js listric.wasm SCENE METRES [ACCURACY]: runs a shipped scene in the module, and prints its state hash.

const fs = require('fs');
const path = require('path');

const apps = path.dirname(__dirname);
const startModule = new Function(`${fs.readFileSync(path.join(__dirname, 'module.js'))}; return startModule;`)();

async function run(file, name, metres, accuracy = 'draft') {
  const module = await startModule(fs.readFileSync(file), (isWarning, text) => isWarning && console.error(text));
  for (const folder of ['materials', 'scenes'])
    for (const one of fs.readdirSync(path.join(apps, folder)))
      module.give(`/listric/${folder}/${one}`, fs.readFileSync(path.join(apps, folder, one), 'utf8'));
  const scene = module.read({scene: name, accuracy});
  const goal = Math.min(Number(metres), scene.distance_m);
  module.begin();
  let now;
  do
    now = module.extend(goal, 1.0);
  while (!now.arrived);
  console.log(now.state_hash);
  const {user} = process.cpuUsage();
  console.error(`${name} to ${metres} m: ${now.discs} discs, ${(user / 1e6).toFixed(1)} s, ` +
    `${(module.memory() / 2 ** 20).toFixed(1)} MiB`);
}

run(...process.argv.slice(2)).catch(error => {
  console.error(error.message);
  process.exit(1);
});
