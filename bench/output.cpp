extern "C" {
#include <libavcodec/avcodec.h>
#include <libavfilter/avfilter.h>
#include <libavfilter/buffersink.h>
#include <libavfilter/buffersrc.h>
#include <libavformat/avformat.h>
#include <libavutil/log.h>
}

#include <fmt/format.h>
#include <unistd.h>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/ratio_table.hpp"
#include "core/files.hpp"
#include "drape/render/renderer.hpp"
#include "drape/scene/scene.hpp"
#include "output/gif_encoder.hpp"
#include "run/frame_source.hpp"
#include "run/run_scene.hpp"

namespace drape {
namespace {

constexpr int drawn_frames = 20;  // evenly spread over the film

struct DrawnFilm {
  LoadedScene scene;
  std::vector<Frame> frames;
  View view;
};

DrawnFilm make_film(const std::string& file) {
  DrawnFilm film{load_scene(data_folder() / file, {}), {}, {}};
  const Scene& scene = film.scene;
  const SimulationSettings& settings = scene.simulation;
  const std::int64_t steps = std::llround(scene.duration / settings.step);
  const int last = static_cast<int>(scene.video.last_frame(scene.duration));
  const FilmExtent extent(scene.video, settings.step, steps, FrameRange{0, last});
  Framing framing(scene.camera, static_cast<double>(scene.video.size.x()) / scene.video.size.y());
  int seen = 0;
  FrameSampler sampler(extent, [&](Frame frame) {
    framing.add(frame.positions);
    for (const Collider& collider : frame.colliders) framing.add(collider);
    framing.end_frame();
    if (seen++ * drawn_frames / last == static_cast<int>(film.frames.size())) film.frames.push_back(std::move(frame));
  });
  const std::array<StepObserver*, 1> observers{&sampler};
  Simulation simulation(settings);
  run_steps(simulation, extent.steps, observers, {});
  film.view = framing.view();
  film.frames.resize(drawn_frames, film.frames.back());
  return film;
}

Subject make_drawing(const std::shared_ptr<DrawnFilm>& film, bool lit) {
  if (film->frames.empty()) *film = make_film(film->scene.source.file);
  Look look = film->scene.look;
  if (!lit) {
    look.shadows = look.ambient_occlusion = false;
    look.translucency = 0;
  }
  const SimulationSettings& settings = film->scene.simulation;
  // Never deleted: benchmarks are destroyed when the process ends, after Mesa has cleaned up.
  auto* renderer = new Renderer(data_folder(), film->scene.video.size, film->view, look, settings.cloth.vertex_count(),
                                settings.cloth.triangles, film->scene.uvs);
  renderer->set_weave(settings.cloth.rest, film->scene.uvs);
  return {.restore = [] {},
          .run =
              [film, renderer] {
                for (const Frame& frame : film->frames) renderer->draw(frame);
                return drawn_frames;
              }};
}

}  // namespace

std::vector<std::string> register_drawing() {
  std::vector<std::string> names;
  for (const char* scene : {"homework/1", "homework/4", "homework/5", "showcase/ground", "showcase/moving_pins",
                            "showcase/moving_sphere", "showcase/self_collision", "showcase/wind"}) {
    const auto film = std::make_shared<DrawnFilm>();
    film->scene.source.file = fmt::format("scenes/{}.toml", scene);
    names.push_back(fmt::format("draw/{}", scene));
    register_subject(names.back(), "with", drawn_frames, [film] { return make_drawing(film, true); });
    register_subject(names.back(), "without", drawn_frames, [film] { return make_drawing(film, false); });
  }
  return names;
}

namespace {

struct Free {
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVFilterGraph* graph) const { avfilter_graph_free(&graph); }
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(AVFormatContext* format) const { avformat_free_context(format); }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

int check(int result) {
  if (result < 0) throw std::runtime_error(fmt::format("FFmpeg fails with {}", result));
  return result;
}

Owned<AVFilterGraph> make_graph(const std::string& description) {
  Owned<AVFilterGraph> graph(avfilter_graph_alloc());
  graph->nb_threads = 1;
  AVFilterInOut *inputs = nullptr, *outputs = nullptr;
  check(avfilter_graph_parse2(graph.get(), description.c_str(), &inputs, &outputs));
  check(avfilter_graph_config(graph.get(), nullptr));
  return graph;
}

/// Makes a frame with an alpha channel, as both filters require.
Owned<AVFrame> rgb32_frame(const Image& image, int number) {
  Owned<AVFrame> frame(av_frame_alloc());
  frame->format = AV_PIX_FMT_RGB32;
  frame->width = image.width;
  frame->height = image.height;
  frame->pts = number;
  check(av_frame_get_buffer(frame.get(), 0));
  for (int y = 0; y < image.height; ++y) {
    auto* out = reinterpret_cast<std::uint32_t*>(frame->data[0] + static_cast<std::ptrdiff_t>(y) * frame->linesize[0]);
    const std::uint8_t* in = image.at(0, y);
    for (int x = 0; x < image.width; ++x, in += 3) {
      out[x] = 0xff000000U | static_cast<std::uint32_t>(in[0] << 16 | in[1] << 8 | in[2]);
    }
  }
  return frame;
}

void push(const Owned<AVFilterGraph>& graph, const char* input, AVFrame* frame) {
  check(av_buffersrc_add_frame_flags(avfilter_graph_get_filter(graph.get(), input), frame, AV_BUFFERSRC_FLAG_PUSH));
}

/// Returns the graph's next frame; null if it has none yet, or none any more.
Owned<AVFrame> pull(const Owned<AVFilterGraph>& graph) {
  Owned<AVFrame> frame(av_frame_alloc());
  const int result = av_buffersink_get_frame(avfilter_graph_get_filter(graph.get(), "buffersink@out"), frame.get());
  if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return nullptr;
  check(result);
  return frame;
}

std::string buffer(const char* name, int width, int height, int fps) {
  return fmt::format("buffer@{}=width={}:height={}:pix_fmt={}:time_base=1/{}", name, width, height,
                     static_cast<int>(AV_PIX_FMT_RGB32), fps);
}

Owned<AVFrame> make_palette(const std::vector<Image>& film, int fps) {
  const auto graph = make_graph(buffer("film", film[0].width, film[0].height, fps) + ", palettegen, buffersink@out");
  for (std::size_t k = 0; k < film.size(); ++k)
    push(graph, "buffer@film", rgb32_frame(film[k], static_cast<int>(k)).get());
  push(graph, "buffer@film", nullptr);
  return pull(graph);
}

/// A GIF in memory that is being written.
class Writer {
 public:
  Writer(int width, int height, int fps) : packet_(av_packet_alloc()) {
    const AVCodec* encoder = avcodec_find_encoder(AV_CODEC_ID_GIF);
    codec_.reset(avcodec_alloc_context3(encoder));
    codec_->width = width;
    codec_->height = height;
    codec_->pix_fmt = AV_PIX_FMT_PAL8;
    codec_->time_base = {1, fps};
    check(avcodec_open2(codec_.get(), encoder, nullptr));
    AVFormatContext* format = nullptr;
    check(avformat_alloc_output_context2(&format, nullptr, "gif", nullptr));
    format_.reset(format);
    AVStream* stream = avformat_new_stream(format, nullptr);
    stream->time_base = codec_->time_base;
    check(avcodec_parameters_from_context(stream->codecpar, codec_.get()));
    check(avio_open_dyn_buf(&format->pb));
    check(avformat_write_header(format, nullptr));
  }

  /// Appends a frame; null ends the film.
  void add(const AVFrame* frame) {
    check(avcodec_send_frame(codec_.get(), frame));
    while (avcodec_receive_packet(codec_.get(), packet_.get()) == 0) {
      av_packet_rescale_ts(packet_.get(), codec_->time_base, format_->streams[0]->time_base);
      check(av_write_frame(format_.get(), packet_.get()));
      av_packet_unref(packet_.get());
    }
  }

  std::size_t finish() {
    add(nullptr);
    check(av_write_trailer(format_.get()));
    std::uint8_t* bytes = nullptr;
    const int size = avio_close_dyn_buf(format_->pb, &bytes);
    av_free(bytes);
    return static_cast<std::size_t>(size);
  }

 private:
  Owned<AVCodecContext> codec_;
  Owned<AVFormatContext> format_;
  Owned<AVPacket> packet_;
};

/// Encodes a film as a GIF in memory with FFmpeg's defaults: palettegen over all frames, then paletteuse, the GIF
/// encoder and the muxer, in one thread.
/// @returns the size of the GIF [bytes]
/// @throws std::runtime_error
std::size_t encode_gif_by_ffmpeg(const std::vector<Image>& film, int fps) {
  av_log_set_level(AV_LOG_QUIET);
  const int width = film[0].width, height = film[0].height;
  const Owned<AVFrame> palette = make_palette(film, fps);
  const auto graph = make_graph(buffer("film", width, height, fps) + " [film]; " + buffer("palette", 16, 16, fps) +
                                " [palette]; [film][palette] paletteuse, buffersink@out");
  palette->pts = 0;
  push(graph, "buffer@palette", palette.get());
  push(graph, "buffer@palette", nullptr);
  Writer writer(width, height, fps);
  const auto write_ready = [&] {
    while (const Owned<AVFrame> frame = pull(graph)) writer.add(frame.get());
  };
  for (std::size_t k = 0; k < film.size(); ++k) {
    push(graph, "buffer@film", rgb32_frame(film[k], static_cast<int>(k)).get());
    write_ready();
  }
  push(graph, "buffer@film", nullptr);
  write_ready();
  return writer.finish();
}

/// The first hundred frames of the homework's fourth film, drawn once for both encoders.
const std::vector<Image>& film() {
  static const std::vector<Image> images = [] {
    const Scene scene = load_scene(data_folder() / "scenes/homework/4.toml", {});
    const SimulationSettings& settings = scene.simulation;
    const std::int64_t steps = std::llround(scene.duration / settings.step);
    const FilmExtent extent(scene.video, settings.step, steps, FrameRange{0, 99});
    std::vector<Frame> frames;
    FrameSampler sampler(extent, [&](Frame frame) { frames.push_back(std::move(frame)); });
    const std::array<StepObserver*, 1> observers{&sampler};
    Simulation simulation(settings);
    run_steps(simulation, extent.steps, observers, {});

    const Eigen::Vector2i size = scene.video.size;
    Framing framing(scene.camera, static_cast<double>(size.x()) / size.y());
    for (const Frame& frame : frames) framing.add(frame.positions);
    Renderer renderer(data_folder(), size, framing.view(), scene.look, settings.cloth.vertex_count(),
                      settings.cloth.triangles, scene.uvs);
    std::vector<Image> drawn;
    for (const Frame& frame : frames) drawn.push_back(renderer.draw(frame));
    return drawn;
  }();
  return images;
}

constexpr int film_rate = 25, frame_count = 100;

Subject make_drape() {
  return {.restore = [] {},
          .run =
              [] {
                const auto file =
                    std::filesystem::temp_directory_path() / fmt::format("drape-bench-{}.gif", ::getpid());
                GifEncoder encoder(file, film_rate, {});
                for (const Image& image : film()) encoder.add(image);
                const bool written = encoder.finish(Ending::complete).size() == 1;
                std::filesystem::remove(file);
                return written ? frame_count : 0;
              }};
}

Subject make_ffmpeg() {
  return {.restore = [] {}, .run = [] { return encode_gif_by_ffmpeg(film(), film_rate) > 0 ? frame_count : 0; }};
}

}  // namespace

std::vector<std::string> register_encoding() {
  const std::string name = "gif_frame/scene_4";
  register_subject(name, "drape", frame_count, make_drape);
  register_subject(name, "ffmpeg", frame_count, make_ffmpeg);
  return {name};
}

}  // namespace drape
