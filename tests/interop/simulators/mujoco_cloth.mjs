// node mujoco_cloth.mjs MODULES FOLDER: a cloth of MuJoCo (flex) falls over a ball; writes OBJ files at 50 frames per
// second. MODULES is the folder node_modules with mujoco-js.
import { mkdirSync, writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [modules, folder] = process.argv.slice(2);
const { default: load } = await import(pathToFileURL(`${modules}/mujoco-js/dist/mujoco_wasm.js`));
const mujoco = await load();
mujoco.FS.writeFile('/cloth.xml', `<mujoco><option timestep="0.002" solver="CG" tolerance="1e-6"/><size memory="200M"/>
<worldbody><geom type="sphere" size="0.3" pos="0 0 0.5"/><geom type="plane" size="3 3 .1"/>
<flexcomp name="cloth" type="grid" dim="2" count="21 21 1" spacing="0.08 0.08 0.08" mass="0.4" radius="0.01" pos="0 0 1.2">
<edge equality="true"/><contact condim="3" solref="0.003" selfcollide="none"/></flexcomp></worldbody></mujoco>`);
const model = mujoco.MjModel.loadFromXML('/cloth.xml');
const data = new mujoco.MjData(model);
mujoco.mj_forward(model, data);
mkdirSync(folder, { recursive: true });
const faces = model.flex_elem;
for (let frame = 0; frame < 60; ++frame) {
  const x = data.flexvert_xpos;
  let text = '';
  for (let i = 0; i < x.length; i += 3) text += `v ${x[i]} ${x[i + 1]} ${x[i + 2]}\n`;
  for (let i = 0; i < faces.length; i += 3) text += `f ${faces[i] + 1} ${faces[i + 1] + 1} ${faces[i + 2] + 1}\n`;
  writeFileSync(`${folder}/${String(frame).padStart(4, '0')}.obj`, text);
  for (let step = 0; step < 10; ++step) mujoco.mj_step(model, data);
}
