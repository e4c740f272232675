#include "codecs/libav_animation.hpp"

#include <fmt/format.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

#include <array>
#include <memory>
#include <stdexcept>
#include <utility>

namespace drape {
namespace {

/// What is to be done with FFmpeg for one form of animation.
struct Form {
  const char* container;
  const char* encoder;
  AVPixelFormat pixels;
  std::pair<const char*, const char*> encoder_option;
  const char* repeats;  // the container's option, of which 0 is for ever
};

Form form_of(const std::string& name) {
  // At this quality, libwebp's own default, a film is half as large as a GIF; without loss it would be larger.
  if (name == "webp") return {"webp", "libwebp_anim", AV_PIX_FMT_BGRA, {"quality", "75"}, "loop"};
  // Each row predicted as compresses best.
  return {"apng", "apng", AV_PIX_FMT_RGB24, {"pred", "mixed"}, "plays"};
}

/// @returns the code, if it is no error
int checked(int code) {
  if (code >= 0) return code;
  std::array<char, AV_ERROR_MAX_STRING_SIZE> reason{};
  av_strerror(code, reason.data(), reason.size());
  throw std::runtime_error(reason.data());
}

/// FFmpeg's objects of one animation, of which libav frees what there is.
class Animation {
 public:
  Animation(const std::string& file, const std::string& name, double fps, cv::Size size) : form_(form_of(name)) {
    av_log_set_level(AV_LOG_QUIET);
    const AVCodec* const codec = avcodec_find_encoder_by_name(form_.encoder);
    if (codec == nullptr) throw std::runtime_error(fmt::format("FFmpeg has no {} encoder", form_.encoder));
    open_encoder(codec, av_d2q(fps, 1'000'000), size);
    open_file(file);
    picture_.reset(av_frame_alloc());
    packet_.reset(av_packet_alloc());
    picture_->format = form_.pixels;
    picture_->width = size.width;
    picture_->height = size.height;
    checked(av_frame_get_buffer(picture_.get(), 0));
  }

  void add(const cv::Mat& rgb) {
    checked(av_frame_make_writable(picture_.get()));
    const bool alpha = form_.pixels == AV_PIX_FMT_BGRA;
    for (int y = 0; y < rgb.rows; ++y) {
      const std::uint8_t* from = rgb.ptr(y);
      std::uint8_t* to = picture_->data[0] + static_cast<std::ptrdiff_t>(y) * picture_->linesize[0];
      if (!alpha) std::copy_n(from, 3 * rgb.cols, to);
      for (int x = 0; alpha && x < rgb.cols; ++x, from += 3, to += 4) {
        to[0] = from[2];
        to[1] = from[1];
        to[2] = from[0];
        to[3] = 255;
      }
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
    encoder_->pix_fmt = form_.pixels;
    encoder_->time_base = av_inv_q(rate);
    encoder_->framerate = rate;
    encoder_->thread_count = 1;
    checked(av_opt_set(encoder_->priv_data, form_.encoder_option.first, form_.encoder_option.second, 0));
    checked(avcodec_open2(encoder_.get(), codec, nullptr));
  }

  void open_file(const std::string& file) {
    AVFormatContext* container = nullptr;
    checked(avformat_alloc_output_context2(&container, nullptr, form_.container, file.c_str()));
    container_.reset(container);
    checked(av_opt_set_int(container->priv_data, form_.repeats, 0, 0));
    container->flags |= AVFMT_FLAG_BITEXACT;
    AVStream* const stream = avformat_new_stream(container, nullptr);
    stream->time_base = encoder_->time_base;
    stream->avg_frame_rate = encoder_->framerate;
    checked(avcodec_parameters_from_context(stream->codecpar, encoder_.get()));
    checked(avio_open(&container->pb, file.c_str(), AVIO_FLAG_WRITE));
    checked(avformat_write_header(container, nullptr));
  }

  /// @param picture null: the last one has been sent
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

  Form form_;
  std::unique_ptr<AVCodecContext, Free> encoder_;
  std::unique_ptr<AVFormatContext, Free> container_;
  std::unique_ptr<AVFrame, Free> picture_;
  std::unique_ptr<AVPacket, Free> packet_;
  std::int64_t count_ = 0;
};

}  // namespace

AnimationPen begin_animation(const std::string& file, const std::string& form, double fps, cv::Size size) {
  const auto animation = std::make_shared<Animation>(file, form, fps, size);
  return [animation](const cv::Mat* rgb) { rgb != nullptr ? animation->add(*rgb) : animation->finish(); };
}

}  // namespace drape
