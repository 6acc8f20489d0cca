// Which camera, lens and setting an image was taken with, from its EXIF data (CIPA DC-008), and whether that
// is what a rig was calibrated with. A calibration belongs to a camera, a lens, a focus and an aperture.
// Keys of Camera::identity: make, model, serial, lens, lens_serial, focal_length_mm, aperture (f-number),
// focus_m, date (as EXIF has it), and whatever the user adds (temperature, ...).
#pragma once
#include <map>
#include <string>
#include <vector>

#include "calibrate/rig.h"

namespace bpms {

// Of a JPEG; empty where the image says nothing of itself.
std::map<std::string, std::string> image_identity(const std::string& path);

// What all images of a camera agree on; the date is that of the first. `notes`: what they differ in, one line
// a key.
std::map<std::string, std::string> common_identity(const std::vector<std::string>& paths,
                                                   std::vector<std::string>& notes);

struct IdentityDifference {
  std::string key, rig, image;
  bool another_camera = false;  // body, lens or focal length: the calibration cannot hold; else a setting
};
// Keys that both sides have and that differ; numbers by more than 0.1 %. The date is not compared.
std::vector<IdentityDifference> identity_differences(const Camera& camera,
                                                     const std::map<std::string, std::string>& image);

// Compares an image with its camera. Another camera is bad_input unless `ignore`; another setting, and what
// is ignored, come back as notes.
std::vector<std::string> require_same_identity(const Camera& camera, const std::string& image, bool ignore);

}  // namespace bpms
