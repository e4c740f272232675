#pragma once

#include "sim/contact/contact.hpp"

namespace drape {

/// How a cloth would go through a step if nothing were in its way.
struct FreeFlight {
  Vertices start_v;                                   ///< velocities when it begins, n×3 [m/s]
  Vertices mean;                                      ///< with which it would go, on average [m/s]
  Vertices target;                                    ///< where it would end [m]
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [m/s²]
  double h = 0;                                       ///< [s]
};

/// What Newton's law of restitution makes of features that arrive in a step at the speed s and leave with e·s, on
/// parabolas under gravity: t seconds into a step of mean velocity w the velocity is w + (t − h/2)·g. A vertex in free
/// flight thus rises to e² of its height, whatever the step; springs make an error of the order of h.
struct Bounce {
  double gap = 0;     ///< how far beyond their distance they end [m]
  double leaves = 0;  ///< mean velocity with which they go on [m/s]
  double turned = 0;  ///< by how much that is more than the one of this step [m/s]
  double struck = 0;  ///< s + e·s [m/s]
};

/// Bounces of what arrives fast enough to leave: faster than what presses it on pushes it back in a step. All zero for
/// anything else.
Bounce bounce_of(const ContactConstraint& contact, const FreeFlight& flight);

/// The change of the velocity of d at the end of a step in which it has bounced: along the normal, and Coulomb's
/// friction of the impact, µ times what that turns at most [m/s].
/// @param slip   velocity of d, relative to the obstacle, as the step leaves it [m/s]
/// @param rubbed what friction has already taken from it, as a change across the normal [m/s]
Eigen::Vector3d change_by(const Bounce& bounce, const ContactConstraint& contact, const Eigen::Vector3d& slip,
                          const Eigen::Vector3d& rubbed);

}  // namespace drape
