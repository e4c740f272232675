#pragma once

#include "sim/contact/contact.hpp"

namespace drape {

/// Motion of a cloth through a step without contact.
struct FreeFlight {
  Vertices start_v;                                   ///< velocities at the start of the step, n×3 [m/s]
  Vertices mean;                                      ///< mean velocities over the step [m/s]
  Vertices target;                                    ///< positions at the end of the step [m]
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [m/s²]
  double h = 0;                                       ///< step length [s]
};

/// Rebound by Newton's law of restitution: features arrive at the speed s and leave at e·s, on parabolas under gravity.
/// With the mean velocity w of a step, the velocity at the time t is w + (t − h/2)·g. A vertex in free flight rises to
/// e² of its height for any step length. Springs add an error of the order of h.
struct Bounce {
  double gap = 0;     ///< gap at the end of the step in excess of the contact distance [m]
  double leaves = 0;  ///< mean velocity after the rebound [m/s]
  double turned = 0;  ///< excess of `leaves` over the mean velocity of this step [m/s]
  double struck = 0;  ///< change of speed at impact, s + e·s [m/s]
};

/// Returns the bounce of a contact. All zero if the rebound is slower than the forces push the features back together
/// within a step.
Bounce bounce_of(const ContactConstraint& contact, const FreeFlight& flight);

/// Returns the change of the velocity of d at the end of a step with a bounce [m/s]. It acts along the normal, plus
/// Coulomb friction of at most µ·struck.
/// @param slip   velocity of d relative to the obstacle at the end of the step [m/s]
/// @param rubbed change across the normal that friction has already made [m/s]
Eigen::Vector3d change_by(const Bounce& bounce, const ContactConstraint& contact, const Eigen::Vector3d& slip,
                          const Eigen::Vector3d& rubbed);

}  // namespace drape
