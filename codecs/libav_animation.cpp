#include "codecs/libav_animation.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>

namespace drape {
namespace {

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

}  // namespace

AnimationPen begin_apng(const std::string& file, double fps, cv::Size size) {
  const auto animation = std::make_shared<Animation>(file, fps, size);
  return [animation](const cv::Mat* rgb) { rgb != nullptr ? animation->add(*rgb) : animation->finish(); };
}

}  // namespace drape
