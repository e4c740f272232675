// node jolt_cloth.mjs MODULES FOLDER: a cloth of Jolt (soft body) falls over a ball; writes OBJ files at 50 frames per
// second. MODULES is the folder node_modules with jolt-physics.
import { mkdirSync, writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [modules, folder] = process.argv.slice(2);
const { default: load } = await import(pathToFileURL(`${modules}/jolt-physics/dist/jolt-physics.wasm-compat.js`));
const Jolt = await load();

// One layer for everything.
const settings = new Jolt.JoltSettings();
const pairs = new Jolt.ObjectLayerPairFilterTable(1);
pairs.EnableCollision(0, 0);
const broad = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
broad.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
settings.mObjectLayerPairFilter = pairs;
settings.mBroadPhaseLayerInterface = broad;
settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(broad, 1, pairs, 1);
const jolt = new Jolt.JoltInterface(settings);
const system = jolt.GetPhysicsSystem();
system.SetGravity(new Jolt.Vec3(0, 0, -9.81));
const bodies = system.GetBodyInterface();

const place = (z) => new Jolt.RVec3(0, 0, z);
const still = new Jolt.Quat(0, 0, 0, 1);
const addRigid = (shape, z) => bodies.CreateAndAddBody(
  new Jolt.BodyCreationSettings(shape, place(z), still, Jolt.EMotionType_Static, 0), Jolt.EActivation_DontActivate);
addRigid(new Jolt.SphereShape(0.3), 0.5);
addRigid(new Jolt.BoxShape(new Jolt.Vec3(3, 3, 0.5)), -0.5);

const side = 21, spacing = 0.08, mass = 0.4;
const shared = new Jolt.SoftBodySharedSettings();
for (let j = 0; j < side; ++j) {
  for (let i = 0; i < side; ++i) {
    const vertex = new Jolt.SoftBodySharedSettingsVertex();
    vertex.mPosition = new Jolt.Float3((i - (side - 1) / 2) * spacing, (j - (side - 1) / 2) * spacing, 0);
    vertex.mInvMass = (side * side) / mass;
    shared.mVertices.push_back(vertex);
  }
}
const faces = [];
for (let j = 0; j + 1 < side; ++j) {
  for (let i = 0; i + 1 < side; ++i) {
    const a = j * side + i;
    faces.push([a, a + 1, a + side + 1], [a, a + side + 1, a + side]);
  }
}
for (const [a, b, c] of faces) shared.AddFace(new Jolt.SoftBodySharedSettingsFace(a, b, c, 0));
const attributes = new Jolt.SoftBodySharedSettingsVertexAttributes();
attributes.mCompliance = attributes.mShearCompliance = 1e-5;
attributes.mBendCompliance = 1e-2;
shared.CreateConstraints(attributes, 1, Jolt.SoftBodySharedSettings_EBendType_Distance);
shared.Optimize();
const creation = new Jolt.SoftBodyCreationSettings(shared, place(1.2), still, 0);
creation.mLinearDamping = 0;
creation.mVertexRadius = 0.01;
creation.mUpdatePosition = false;
const cloth = bodies.CreateSoftBody(creation);
bodies.AddBody(cloth.GetID(), Jolt.EActivation_Activate);

const vertices = Jolt.castObject(cloth.GetMotionProperties(), Jolt.SoftBodyMotionProperties).GetVertices();
mkdirSync(folder, { recursive: true });
for (let frame = 0; frame < 60; ++frame) {
  let text = '';
  for (let i = 0; i < side * side; ++i) {
    const x = vertices.at(i).mPosition;
    text += `v ${x.GetX()} ${x.GetY()} ${x.GetZ() + 1.2}\n`;
  }
  for (const [a, b, c] of faces) text += `f ${a + 1} ${b + 1} ${c + 1}\n`;
  writeFileSync(`${folder}/${String(frame).padStart(4, '0')}.obj`, text);
  for (let step = 0; step < 4; ++step) jolt.Step(1 / 200, 1);
}
