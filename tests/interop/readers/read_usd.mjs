// node read_usd.mjs MODULES FILE: prints the motion of a USD file as read by three's USDLoader, in the form of
// interop_test.cpp, and checks that the stricter tinyusdz reads the same mesh. MODULES is the folder node_modules with
// both.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [modules, file] = process.argv.slice(2);
const from = (path) => import(pathToFileURL(`${modules}/${path}`));
const { Vector3 } = await from('three/build/three.module.js');
const { USDLoader } = await from('three/examples/jsm/loaders/USDLoader.js');
const { USDAParser } = await from('three/examples/jsm/loaders/usd/USDAParser.js');

const text = readFileSync(file, 'utf8');
const specs = new USDAParser().parseData(text).specsByPath;
const scene = new USDLoader().parse(text);
scene.updateMatrixWorld(true);
// three has y up: (x, y, z) of a scene with z up is shown at (x, z, −y).
const shown = (name, x) => {
  const y = new Vector3(...x).applyMatrix4(scene.getObjectByName(name).matrixWorld);
  return [y.x, -y.z, y.y];
};
const indices = specs['/Scene/Cloth.faceVertexIndices'].fields.default;
for (let i = 0; i < indices.length; i += 3) console.log('f', ...indices.slice(i, i + 3));

const { times, values } = specs['/Scene/Cloth.points'].fields.timeSamples;
const centers = specs['/Scene/Sphere1.xformOp:translate'].fields.timeSamples;
const radius = specs['/Scene/Sphere1.radius'].fields.default;
const rate = specs['/'].fields.timeCodesPerSecond;
times.forEach((code, k) => {
  console.log('t', code / rate);
  for (let i = 0; i < values[k].length; i += 3) console.log('v', ...shown('Cloth', values[k].slice(i, i + 3)));
  assert.equal(centers.times[k], code);
  console.log('s', ...shown('Scene', centers.values[k].slice(0, 3)), radius);
});
const drawn = scene.getObjectByName('Cloth').geometry.attributes.position.array;
assert.deepEqual([...drawn], indices.flatMap((i) => values[0].slice(3 * i, 3 * i + 3)).map(Math.fround));

// tinyusdz is built for browsers.
globalThis.window = globalThis;
const { argv: _, ...rest } = process;
Object.defineProperty(globalThis, 'process', { value: { ...rest, versions: {} } });
const { default: start } = await from('tinyusdz/tinyusdz.js');
const native = await start({ wasmBinary: readFileSync(`${modules}/tinyusdz/tinyusdz.wasm`) });
const loader = new native.TinyUSDZLoaderNative();
assert.ok(loader.loadFromBinary(readFileSync(file), file), loader.error());
const mesh = loader.getMesh(0);
assert.deepEqual([...mesh.faceVertexIndices], indices);
assert.deepEqual([...mesh.points], values[0].map(Math.fround));
