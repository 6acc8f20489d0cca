// The grey picture of a JPEG, with what the decoder would only have murmured about: it fills what is missing
// or broken with grey and goes on.
#pragma once
#include <string>
#include <string_view>

namespace cv {
class Mat;
}

namespace bpms {

// Returns what is wrong; empty when all of it was there.
std::string decode_jpeg_grey(std::string_view bytes, cv::Mat& out);

}  // namespace bpms
