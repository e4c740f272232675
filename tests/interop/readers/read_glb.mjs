// node read_glb.mjs MODULES FILE: checks a binary glTF with Khronos' validator, which must find neither errors nor
// warnings, and prints its motion as shown by three's GLTFLoader and animations, in the form of interop_test.cpp.
// MODULES is the folder node_modules with both.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [modules, file] = process.argv.slice(2);
const bytes = readFileSync(file);
const validator = createRequire(import.meta.url)(`${modules}/gltf-validator`);
const { issues } = await validator.validateBytes(new Uint8Array(bytes));
assert.equal(issues.numErrors, 0, JSON.stringify(issues.messages));
assert.equal(issues.numWarnings, 0, JSON.stringify(issues.messages));

globalThis.self = globalThis;
const from = (path) => import(pathToFileURL(`${modules}/${path}`));
const { AnimationMixer, Vector3 } = await from('three/build/three.module.js');
const { GLTFLoader } = await from('three/examples/jsm/loaders/GLTFLoader.js');
const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
const { scene, animations } = await new GLTFLoader().parseAsync(buffer, '');

const cloth = scene.getObjectByName('Cloth'), ball = scene.getObjectByName('Sphere1');
const { index } = cloth.geometry;
for (let i = 0; i < index.count; i += 3) console.log('f', index.getX(i), index.getX(i + 1), index.getX(i + 2));
const mixer = new AnimationMixer(scene);
const action = mixer.clipAction(animations[0]);
action.play();
// three has y up: (x, y, z) of a scene with z up is shown at (x, z, −y).
const out = (kind, v, ...more) => console.log(kind, v.x, -v.z, v.y, ...more);
for (const time of animations[0].tracks[0].times) {
  action.time = time;
  mixer.update(0);
  scene.updateMatrixWorld(true);
  console.log('t', time);
  for (let i = 0; i < cloth.geometry.attributes.position.count; ++i) {
    out('v', cloth.getVertexPosition(i, new Vector3()).applyMatrix4(cloth.matrixWorld));
  }
  ball.geometry.computeBoundingSphere();
  out('s', ball.getWorldPosition(new Vector3()), ball.geometry.boundingSphere.radius);
}
