// Result files as the RAMI On-line Model Checker takes them: MES_MODEL-EXPERIMENT.mes with MES in brfpp,
// brfop (principal and orthogonal plane), each also with _uc_sgl, _co_sgl, _mlt. First line: rows, columns,
// ratio of filtered rays (-1: not available); then SZA VZA SAA-VAA BRF standard deviation, radians. VZA is
// never negative: in the principal plane SAA-VAA is 0 on the sun's side (where our signed vza is negative)
// and pi on the other. Azimuths count as the scene's do.
#pragma once
#include <utility>

#include "simulate/simulate.h"

namespace bpms {

struct RomcFile {
  std::string path;
  std::size_t sensor = 0, band = 0;
  std::string measurement;  // "brfpp_co_sgl"
  Component component = Component::all;
};
// For every `brf` sensor that lies in a plane, every band: what EXPERIMENT (a path whose last part is the
// experiment's name) stands for. Several bands are told apart by their wavelength, or number; of several
// sensors in one plane the first is taken. Without a single sun, or without a sensor in a plane: bad_input.
std::vector<RomcFile> romc_files(const Simulation& simulation, const std::string& experiment);
std::string romc_text(const Simulation& simulation, const Result& result, const RomcFile& file);

}  // namespace bpms
