// The files that materials name, from arbitrary bytes: rasters of maps and bumps, tables of PROSPECT and of
// reflectance, spectra. What is accepted can be used.
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "simulate/materials/prospect_table.h"
#include "simulate/materials/raster_file.h"
#include "simulate/materials/spectrum.h"
#include "simulate/materials/tabulated.h"
#include "tests/fuzz/answer.h"

namespace {

const char* const name = "fuzz.bin";

void look_at(const bpms::Raster& raster) {
  if (raster.columns() * raster.rows() != raster.values().size()) std::abort();
  for (const float u : {0.0f, 0.3f, 1.0f, -7.5f, 1e-30f}) {
    if (!std::isfinite(raster.nearest({u, -u}))) std::abort();
    if (!std::isfinite(raster.bilinear({-u, u}).value)) std::abort();
  }
}

// Of spectra there is a reader of files alone.
void read_as_spectrum(const std::string& bytes) {
  static const std::string path =
      (std::filesystem::temp_directory_path() / ("bpms-fuzz-" + std::to_string(getpid()))).string();
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  const bpms::TomlDocument document =
      bpms::TomlDocument::parse(name, "reflectance = " + bpms::toml_string(path) + "\n");
  const bpms::Bands bands{{450, 650}};
  std::vector<std::string> inputs;
  try {
    for (const double value : bpms::read_spectrum(document.root().get("reflectance"), bands, 0, 1, inputs))
      if (!(value >= 0 && value <= 1)) std::abort();
  } catch (const bpms::Error& error) {
    if (error.kind() != bpms::ErrorKind::bad_input) std::abort();
    if (error.where().file != path && error.where().file != name) std::abort();
    if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  bpms::fuzz::answer(name, [&] { look_at(bpms::parse_integers(name, bytes)); });
  bpms::fuzz::answer(name, [&] { look_at(bpms::parse_heights(name, bytes)); });
  bpms::fuzz::answer(name, [&] {
    const bpms::ProspectTable table = bpms::parse_prospect_table(name, bytes);
    if (table.nm.size() != table.refractive_index.size()) std::abort();
    for (const auto& absorption : table.absorption)
      if (!absorption.empty() && absorption.size() != table.nm.size()) std::abort();
  });
  bpms::fuzz::answer(name, [&] {
    const bpms::BrfTable table = bpms::parse_brf_table(name, bytes, bpms::Bands{{650}});
    for (const auto& set : table.brf)
      if (set.size() != table.light_deg.size() * table.view_deg.size() * table.azimuth_deg.size())
        std::abort();
  });
  read_as_spectrum(bytes);
  return 0;
}
