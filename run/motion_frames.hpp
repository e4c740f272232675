#pragma once

#include <stop_token>

#include "motion/reader.hpp"
#include "run/frame_sampler.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Hands out the frames of a motion file. They equal those of the simulation to the bit if the file stores the states
/// that they need. Returns early when a stop is requested.
/// @param scene of the motion, for its colliders
void sample_motion(MotionReader& motion, const Scene& scene, const FilmExtent& extent, FrameContents contents,
                   const FrameInterpolator::Receiver& receiver, const std::stop_token& stop);

/// Returns the number of frames that fall between states more than one step apart; a simulation would give others.
int frames_in_gaps(const MotionReader& motion, const FilmExtent& extent);

}  // namespace drape
