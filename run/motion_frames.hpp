#pragma once

#include <stop_token>

#include "motion/reader.hpp"
#include "run/frame_sampler.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Hands out the frames of a motion that is in a file, to the bit those that its simulation would give where its states
/// are those that they need. Returns early when a stop is requested.
/// @param scene of the motion, for what the cloth can touch
void sample_motion(MotionReader& motion, const Scene& scene, const FilmExtent& extent, FrameContents contents,
                   const FrameTaker::Receiver& receiver, const std::stop_token& stop);

/// How many frames fall between states that are more than a step apart, so that a simulation would give others.
int frames_in_gaps(const MotionReader& motion, const FilmExtent& extent);

}  // namespace drape
