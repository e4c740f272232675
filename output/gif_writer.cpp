#include "output/gif_writer.hpp"

extern "C" {
#include <libavutil/opt.h>
}

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace drape {
namespace {

constexpr AVRational time_base{1, 100};

/// The GIF encoder of FFmpeg, for pictures that paletteuse made.
libav::Codec open_codec(int width, int height) {
  const AVCodec* encoder = avcodec_find_encoder(AV_CODEC_ID_GIF);
  if (!encoder) libav::check(AVERROR_ENCODER_NOT_FOUND, "cannot encode a GIF");
  libav::Codec codec(libav::allocated(avcodec_alloc_context3(encoder)));
  codec->width = width;
  codec->height = height;
  codec->pix_fmt = AV_PIX_FMT_PAL8;
  codec->time_base = time_base;
  libav::check(av_opt_set(codec->priv_data, "gifflags", "+offsetting+transdiff", 0), "cannot encode a GIF");
  libav::check(avcodec_open2(codec.get(), encoder, nullptr), "cannot encode a GIF");
  return codec;
}

libav::Frame palette_frame(const GifPalette& palette) {
  libav::Frame frame = libav::rgb32_frame(16, 16);
  for (int y = 0; y < 16; ++y) {
    std::copy_n(palette.colors.begin() + 16 * y, 16,
                reinterpret_cast<std::uint32_t*>(frame->data[0] + y * frame->linesize[0]));
  }
  frame->pts = 0;
  return frame;
}

}  // namespace

GifWriter::GifWriter(const std::filesystem::path& file, std::string name, int width, int height,
                     const GifPalette& palette, std::int64_t last_duration)
    : name_(std::move(name)),
      dither_(palette),
      graph_(fmt::format("buffer@film=width={0}:height={1}:pix_fmt={2}:time_base=1/100 [film]; "
                         "buffer@palette=width=16:height=16:pix_fmt={2}:time_base=1/100 [palette]; "
                         "[film][palette] paletteuse=dither=none, buffersink@gif",
                         width, height, static_cast<int>(AV_PIX_FMT_RGB32))),
      compactor_(palette),
      codec_(open_codec(width, height)),
      packet_(libav::allocated(av_packet_alloc())),
      bytes_per_frame_(0.14 * width * height) {
  graph_.push("buffer@palette", palette_frame(palette));
  graph_.push("buffer@palette", nullptr);

  AVFormatContext* format = nullptr;
  checked(avformat_alloc_output_context2(&format, nullptr, "gif", nullptr));
  format_.reset(format);
  AVStream* stream = libav::allocated(avformat_new_stream(format, nullptr));
  stream->time_base = time_base;
  checked(avcodec_parameters_from_context(stream->codecpar, codec_.get()));
  checked(av_opt_set_int(format->priv_data, "loop", 0, 0));  // for ever
  checked(av_opt_set_int(format->priv_data, "final_delay", last_duration, 0));
  checked(avio_open(&format->pb, file.c_str(), AVIO_FLAG_WRITE));
  checked(avformat_write_header(format, nullptr));
}

void GifWriter::checked(int result) const { libav::check(result, "cannot write " + name_); }

void GifWriter::add(const Image& image, std::int64_t start) {
  libav::Frame frame = dither_.apply(image);
  frame->pts = start;
  sources_.push_back(image);
  graph_.push("buffer@film", std::move(frame));
  encode_filtered();
}

int GifWriter::tolerance() const {
  // In proportion to the debt, so that it settles where a frame takes what it may. Beyond the largest, edges fray.
  constexpr double largest = 32, frames_of_debt = 12;
  return static_cast<int>(std::clamp(largest * debt_ / (frames_of_debt * bytes_per_frame_), 0.0, largest));
}

void GifWriter::encode_filtered() {
  while (const libav::Frame frame = graph_.pull("buffersink@gif")) {
    checked(av_frame_make_writable(frame.get()));
    compactor_.compact(*frame, sources_.front(), tolerance());
    sources_.pop_front();
    debt_ -= bytes_per_frame_;
    encode(frame.get());
  }
}

void GifWriter::encode(const AVFrame* frame) {
  checked(avcodec_send_frame(codec_.get(), frame));
  for (;;) {
    const int result = avcodec_receive_packet(codec_.get(), packet_.get());
    if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
    checked(result);
    debt_ += packet_->size;
    checked(av_write_frame(format_.get(), packet_.get()));
    av_packet_unref(packet_.get());
    // The muxer does not look whether the file could be written.
    checked(format_->pb->error);
  }
}

void GifWriter::finish() {
  graph_.push("buffer@film", nullptr);
  encode_filtered();
  encode(nullptr);
  checked(av_write_trailer(format_.get()));
  avio_flush(format_->pb);
  checked(format_->pb->error);
  checked(avio_closep(&format_->pb));
}

}  // namespace drape
