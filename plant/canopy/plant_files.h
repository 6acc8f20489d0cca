// The plant files of a stand, read on all threads.
#pragma once
#include <string>
#include <vector>

#include "core/toml.h"
#include "plant/plant_source.h"

namespace bpms {

// The files of a [[plants]] entry: its file, or the .bpms files of its folder in order of their names.
std::vector<std::string> plant_files(const TomlValue& entry);

// Reads them; the error of the first that has one. Warnings that differ in nothing but the file become one
// note with a count.
PlantSet read_plant_files(const std::vector<std::string>& files);

}  // namespace bpms
