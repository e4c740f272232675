#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavfilter/avfilter.h>
#include <libavformat/avformat.h>
#include <libavutil/frame.h>
}

#include <memory>
#include <string>
#include <string_view>

#include "render/image.hpp"

/// Owners of what FFmpeg's C libraries allocate.
namespace drape::libav {

struct Free {
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVFilterGraph* graph) const { avfilter_graph_free(&graph); }
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  /// Closes the file too.
  void operator()(AVFormatContext* format) const;
};
using Frame = std::unique_ptr<AVFrame, Free>;
using Packet = std::unique_ptr<AVPacket, Free>;
using Graph = std::unique_ptr<AVFilterGraph, Free>;
using Codec = std::unique_ptr<AVCodecContext, Free>;
using Format = std::unique_ptr<AVFormatContext, Free>;

/// Keeps FFmpeg from writing to the terminal: what goes wrong is reported by exceptions. For the whole process.
void silence();

/// @returns `result` unless it is an error number of FFmpeg
/// @throws OutputError "`what`: the error's text"
int check(int result, std::string_view what);

/// Makes sure that an allocation succeeded. @throws std::bad_alloc
template <class T>
T* allocated(T* pointer) {
  if (!pointer) throw std::bad_alloc();
  return pointer;
}

/// An opaque picture in FFmpeg's format RGB32, in which a pixel is the number 0xAARRGGBB.
Frame rgb32_frame(int width, int height);

/// A filter graph with the inputs and the output that its description names, as in
/// "buffer@in=...; [in] palettegen, buffersink@out".
class FilterGraph {
 public:
  /// @throws OutputError if a filter is missing or does not take its options
  explicit FilterGraph(const std::string& description);

  /// Hands over a frame, or with nullptr says that no more will come.
  void push(const char* input, Frame frame);

  /// The next frame out of the graph; nullptr if it needs more input first, or there is none left.
  Frame pull(const char* output);

 private:
  AVFilterContext* filter(const char* name) const;

  Graph graph_;
};

}  // namespace drape::libav
