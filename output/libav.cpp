#include "output/libav.hpp"

extern "C" {
#include <libavfilter/buffersink.h>
#include <libavfilter/buffersrc.h>
#include <libavutil/log.h>
}

#include <fmt/format.h>

#include <array>
#include <new>
#include <stdexcept>

#include "core/error.hpp"

namespace drape::libav {

void Free::operator()(AVFormatContext* format) const {
  avio_closep(&format->pb);
  avformat_free_context(format);
}

void silence() { av_log_set_level(AV_LOG_QUIET); }

int check(int result, std::string_view what) {
  if (result >= 0) return result;
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(result, text.data(), text.size());
  throw OutputError(fmt::format("{}: {}", what, text.data()));
}

Frame rgb32_frame(int width, int height) {
  Frame frame(allocated(av_frame_alloc()));
  frame->format = AV_PIX_FMT_RGB32;
  frame->width = width;
  frame->height = height;
  check(av_frame_get_buffer(frame.get(), 0), "cannot make a picture");
  return frame;
}

FilterGraph::FilterGraph(const std::string& description) : graph_(allocated(avfilter_graph_alloc())) {
  constexpr const char* problem = "cannot set up FFmpeg's filters";
  graph_->nb_threads = 1;  // frames are small, and the threads would cost more than they bring
  AVFilterInOut *inputs = nullptr, *outputs = nullptr;
  const int result = avfilter_graph_parse2(graph_.get(), description.c_str(), &inputs, &outputs);
  const bool open_ends = inputs || outputs;
  avfilter_inout_free(&inputs);
  avfilter_inout_free(&outputs);
  check(result, problem);
  if (open_ends) throw std::logic_error("a filter graph has open ends: " + description);
  check(avfilter_graph_config(graph_.get(), nullptr), problem);
}

AVFilterContext* FilterGraph::filter(const char* name) const {
  AVFilterContext* found = avfilter_graph_get_filter(graph_.get(), name);
  if (!found) throw std::logic_error(fmt::format("the filter graph has no {}", name));
  return found;
}

void FilterGraph::push(const char* input, Frame frame) {
  // Without the flag, frames pile up before the first filter until someone pulls.
  check(av_buffersrc_add_frame_flags(filter(input), frame.get(), AV_BUFFERSRC_FLAG_PUSH), "cannot filter a picture");
}

Frame FilterGraph::pull(const char* output) {
  Frame frame(allocated(av_frame_alloc()));
  const int result = av_buffersink_get_frame(filter(output), frame.get());
  if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return nullptr;
  check(result, "cannot filter a picture");
  return frame;
}

}  // namespace drape::libav
