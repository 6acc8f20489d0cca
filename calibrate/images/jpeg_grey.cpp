#include "calibrate/images/jpeg_grey.h"

#include <csetjmp>
#include <cstdio>
#include <opencv2/core.hpp>

#include <jpeglib.h>

namespace bpms {
namespace {

struct JpegErrors {
  jpeg_error_mgr manager;
  std::jmp_buf back;
  char message[JMSG_LENGTH_MAX];
};

[[noreturn]] void leave_decoder(j_common_ptr decoder) {
  auto* errors = reinterpret_cast<JpegErrors*>(decoder->err);
  errors->manager.format_message(decoder, errors->message);
  std::longjmp(errors->back, 1);
}
// Warnings are counted by the library; the first one is kept.
void keep_warning(j_common_ptr decoder, int level) {
  if (level >= 0) return;
  auto* errors = reinterpret_cast<JpegErrors*>(decoder->err);
  if (errors->manager.num_warnings++ == 0) errors->manager.format_message(decoder, errors->message);
}

// No object of this function needs a destructor: it is left by longjmp.
bool decode(jpeg_decompress_struct& decoder, JpegErrors& errors, std::string_view bytes, cv::Mat& out) {
  if (setjmp(errors.back) != 0) return false;
  jpeg_create_decompress(&decoder);
  jpeg_mem_src(&decoder, reinterpret_cast<const unsigned char*>(bytes.data()),
               static_cast<unsigned long>(bytes.size()));
  jpeg_read_header(&decoder, TRUE);
  decoder.out_color_space = JCS_GRAYSCALE;
  jpeg_start_decompress(&decoder);
  out.create(static_cast<int>(decoder.output_height), static_cast<int>(decoder.output_width), CV_8U);
  while (decoder.output_scanline < decoder.output_height) {
    JSAMPROW row = out.ptr(static_cast<int>(decoder.output_scanline));
    jpeg_read_scanlines(&decoder, &row, 1);
  }
  jpeg_finish_decompress(&decoder);
  return true;
}

}  // namespace

std::string decode_jpeg_grey(std::string_view bytes, cv::Mat& out) {
  JpegErrors errors{};
  jpeg_decompress_struct decoder{};
  decoder.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = leave_decoder;
  errors.manager.emit_message = keep_warning;
  const bool whole = decode(decoder, errors, bytes, out);
  const long warnings = errors.manager.num_warnings;
  jpeg_destroy_decompress(&decoder);
  if (whole && warnings == 0) return {};
  out.release();
  return std::string("is cut short or damaged: ") + errors.message;
}

}  // namespace bpms
