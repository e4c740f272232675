#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <mutex>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>

#include "output/codecs/codecs.hpp"
#include "output/codecs/webp.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/log.h>
#include <libavutil/opt.h>
}

// The module: drape links none of it, and finds it by the single name at the end.

namespace drape {
namespace {

/// Redirects stderr to nowhere during its lifetime: OpenCV 4.6 prints which video tag it substitutes, and no setting
/// prevents it. It affects the whole process, so keep it short: printing code that holds the same mutex waits.
class QuietStderr {
 public:
  explicit QuietStderr(std::mutex& console);
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  std::scoped_lock<std::mutex> lock_;
  int kept_ = -1;  // descriptor of the original stderr
};

QuietStderr::QuietStderr(std::mutex& console) : lock_(console) {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  std::fflush(stderr);
  kept_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (kept_ >= 0) ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

QuietStderr::~QuietStderr() {
  if (kept_ < 0) return;
  std::fflush(stderr);
  ::dup2(kept_, STDERR_FILENO);
  ::close(kept_);
}

/// Silences FFmpeg, which OpenCV uses, on the terminal: exceptions report errors. Holds for the whole process until
/// OpenCV turns the messages on again, at its first use.
void silence_ffmpeg() { av_log_set_level(AV_LOG_QUIET); }

/// Throws std::runtime_error with libav's message for an error code. @returns other codes
int checked(int code) {
  if (code >= 0) return code;
  std::array<char, AV_ERROR_MAX_STRING_SIZE> reason{};
  av_strerror(code, reason.data(), reason.size());
  throw std::runtime_error(reason.data());
}

/// Owner of FFmpeg's objects of one animation; safe to destroy when only partly built.
class Animation {
 public:
  Animation(const std::string& file, double fps, cv::Size size) {
    av_log_set_level(AV_LOG_QUIET);
    const AVCodec* const codec = avcodec_find_encoder_by_name("apng");
    if (codec == nullptr) throw std::runtime_error("FFmpeg has no apng encoder");
    open_encoder(codec, av_d2q(fps, 1'000'000), size);
    open_file(file);
    picture_.reset(av_frame_alloc());
    packet_.reset(av_packet_alloc());
    picture_->format = pixels;
    picture_->width = size.width;
    picture_->height = size.height;
    checked(av_frame_get_buffer(picture_.get(), 0));
  }

  void add(const cv::Mat& rgb) {
    checked(av_frame_make_writable(picture_.get()));
    for (int y = 0; y < rgb.rows; ++y) {
      std::copy_n(rgb.ptr(y), 3 * rgb.cols, picture_->data[0] + static_cast<std::ptrdiff_t>(y) * picture_->linesize[0]);
    }
    picture_->pts = count_++;
    send(picture_.get());
  }

  void finish() {
    send(nullptr);
    checked(av_write_trailer(container_.get()));
    avio_flush(container_->pb);
    checked(container_->pb->error);
    checked(avio_closep(&container_->pb));
  }

 private:
  void open_encoder(const AVCodec* codec, AVRational rate, cv::Size size) {
    encoder_.reset(avcodec_alloc_context3(codec));
    encoder_->width = size.width;
    encoder_->height = size.height;
    encoder_->pix_fmt = pixels;
    encoder_->time_base = av_inv_q(rate);
    encoder_->framerate = rate;
    encoder_->thread_count = 1;
    checked(
        av_opt_set(encoder_->priv_data, "pred", "mixed", 0));  // lets the encoder choose the best prediction per row
    checked(avcodec_open2(encoder_.get(), codec, nullptr));
  }

  void open_file(const std::string& file) {
    AVFormatContext* container = nullptr;
    checked(avformat_alloc_output_context2(&container, nullptr, "apng", file.c_str()));
    container_.reset(container);
    checked(av_opt_set_int(container->priv_data, "plays", 0, 0));
    container->flags |= AVFMT_FLAG_BITEXACT;
    AVStream* const stream = avformat_new_stream(container, nullptr);
    stream->time_base = encoder_->time_base;
    stream->avg_frame_rate = encoder_->framerate;
    checked(avcodec_parameters_from_context(stream->codecpar, encoder_.get()));
    checked(avio_open(&container->pb, file.c_str(), AVIO_FLAG_WRITE));
    checked(avformat_write_header(container, nullptr));
  }

  /// @param picture null: end of the animation
  void send(const AVFrame* picture) {
    checked(avcodec_send_frame(encoder_.get(), picture));
    while (true) {
      const int code = avcodec_receive_packet(encoder_.get(), packet_.get());
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
      checked(code);
      av_packet_rescale_ts(packet_.get(), encoder_->time_base, container_->streams[0]->time_base);
      checked(av_write_frame(container_.get(), packet_.get()));
      av_packet_unref(packet_.get());
    }
  }

  struct Free {
    void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
    void operator()(AVFormatContext* context) const {
      avio_closep(&context->pb);
      avformat_free_context(context);
    }
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  };

  static constexpr AVPixelFormat pixels = AV_PIX_FMT_RGB24;
  std::unique_ptr<AVCodecContext, Free> encoder_;
  std::unique_ptr<AVFormatContext, Free> container_;
  std::unique_ptr<AVFrame, Free> picture_;
  std::unique_ptr<AVPacket, Free> packet_;
  std::int64_t count_ = 0;
};

/// Implements Codecs::begin_animation for APNG with FFmpeg's libraries: OpenCV cannot write APNG with them.
AnimationPen begin_apng(const std::string& file, double fps, cv::Size size) {
  const auto animation = std::make_shared<Animation>(file, fps, size);
  return [animation](const cv::Mat* rgb) { rgb != nullptr ? animation->add(*rgb) : animation->finish(); };
}

std::mutex* console = nullptr;  // the program's mutex, see QuietStderr

cv::Mat decode(std::string_view bytes, int flags) {
  const cv::Mat all(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
  const QuietStderr quiet(*console);  // libpng would print errors without the file's name
  return cv::imdecode(all, flags);
}

VideoPen begin_video(const std::string& file, const std::string& fourcc, double fps, cv::Size size) {
  const QuietStderr quiet(*console);
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::VideoWriter writer;
  const int code = cv::VideoWriter::fourcc(fourcc[0], fourcc[1], fourcc[2], fourcc[3]);
  const bool opened = writer.open(file, cv::CAP_FFMPEG, code, fps, size);
  silence_ffmpeg();  // OpenCV turns its messages on at first use
  if (!opened) return {};
  return [writer](const cv::Mat& bgr) mutable { writer.write(bgr); };
}

AnimationPen begin_animation(const std::string& file, const std::string& form, double fps, cv::Size size) {
  return form == "webp" ? begin_webp(file, fps, size) : begin_apng(file, fps, size);
}

cv::VideoCapture opened(const std::string& file) {
  const QuietStderr quiet(*console);
  cv::VideoCapture video(file, cv::CAP_FFMPEG);
  silence_ffmpeg();  // OpenCV has just turned them on
  return video;
}

int readable_frames(const std::string& file) {
  int found = 0;
  for (cv::VideoCapture video = opened(file); video.isOpened() && video.grab();) ++found;
  return found;
}

}  // namespace
}  // namespace drape

extern "C" const drape::Codecs* drape_codecs(std::mutex& console) {
  drape::console = &console;
  static constexpr drape::Codecs codecs{drape::decode, drape::begin_video, drape::begin_animation,
                                        drape::readable_frames};
  return &codecs;
}
