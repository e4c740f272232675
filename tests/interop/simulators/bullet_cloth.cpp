// bullet_cloth FOLDER: a cloth of Bullet (btSoftBody) falls over a ball; writes OBJ files at 50 frames per second.
// Not part of drape's build: imported_test.cpp compiles it with pkg-config bullet, if that is installed.
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include <btBulletDynamicsCommon.h>

#include <cstdio>
#include <filesystem>
#include <string>

int main(int, char** arguments) {
  const std::string folder = arguments[1];
  std::filesystem::create_directories(folder);
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broad_phase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broad_phase, &solver, &configuration);
  const btVector3 gravity(0, 0, -9.81F);
  world.setGravity(gravity);
  world.getWorldInfo().m_gravity = gravity;
  world.getWorldInfo().m_sparsesdf.Initialize();

  btSphereShape ball(0.3F);
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  const auto add_rigid = [&](btCollisionShape& shape, float z) {
    auto* const state = new btDefaultMotionState(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, z)));
    world.addRigidBody(new btRigidBody(0, state, &shape));  // never deleted, as in Bullet's own examples
  };
  add_rigid(ball, 0.5F);
  add_rigid(plane, 0);

  const float half = 0.8F, z = 1.2F;
  btSoftBody* const cloth =
      btSoftBodyHelpers::CreatePatch(world.getWorldInfo(), btVector3(-half, -half, z), btVector3(half, -half, z),
                                     btVector3(-half, half, z), btVector3(half, half, z), 21, 21, 0, true);
  cloth->m_materials[0]->m_kLST = 0.9F;
  cloth->generateBendingConstraints(2, cloth->m_materials[0]);
  cloth->m_cfg.piterations = 20;
  cloth->m_cfg.kDF = 0.3F;
  cloth->getCollisionShape()->setMargin(0.01F);
  cloth->setTotalMass(0.4F);
  world.addSoftBody(cloth);

  for (int frame = 0; frame < 60; ++frame) {
    char name[32];
    std::snprintf(name, sizeof name, "/%04d.obj", frame);
    std::FILE* const file = std::fopen((folder + name).c_str(), "w");
    if (file == nullptr) return 1;
    const btSoftBody::Node* const first = &cloth->m_nodes[0];
    for (int i = 0; i < cloth->m_nodes.size(); ++i) {
      const btVector3& x = cloth->m_nodes[i].m_x;
      std::fprintf(file, "v %.9g %.9g %.9g\n", x.x(), x.y(), x.z());
    }
    for (int i = 0; i < cloth->m_faces.size(); ++i) {
      const auto& n = cloth->m_faces[i].m_n;
      std::fprintf(file, "f %ld %ld %ld\n", n[0] - first + 1, n[1] - first + 1, n[2] - first + 1);
    }
    std::fclose(file);
    for (int step = 0; step < 4; ++step) world.stepSimulation(1 / 200.F, 0, 1 / 200.F);
  }
  return 0;
}
