#include "plant/canopy/plant_files.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <map>
#include <set>

#include "core/parallel.h"

namespace bpms {
namespace {

// What a warning says without its place: "file:3:7: text" -> "text".
std::string_view without_place(std::string_view warning, std::string_view file) {
  if (warning.substr(0, file.size()) != file) return warning;
  const std::size_t text = warning.find_first_not_of("0123456789: ", file.size());
  return text == std::string_view::npos ? warning : warning.substr(text);
}

void collect_notes(PlantSet& set) {
  struct Alike {
    std::string first;
    std::size_t files = 0;
    std::size_t last = 0;  // file that was counted last, from 1
  };
  std::vector<Alike> notes;
  std::map<std::string, std::size_t, std::less<>> known;
  for (std::size_t i = 0; i < set.plants.size(); ++i) {
    for (const std::string& warning : set.plants[i].plant->warnings) {
      const auto found =
          known.try_emplace(std::string(without_place(warning, set.plants[i].file)), notes.size());
      if (found.second) notes.push_back({warning});
      Alike& alike = notes[found.first->second];
      if (alike.last == i + 1) {  // twice in one file: at two places
        if (alike.files == 1) set.notes.push_back(warning);
        continue;
      }
      alike.last = i + 1;
      ++alike.files;
    }
  }
  for (const Alike& alike : notes)
    set.notes.push_back(
        alike.files == 1 ? alike.first
                         : fmt::format("{} (and the same of {} more plants)", alike.first, alike.files - 1));
}

}  // namespace

std::vector<std::string> plant_files(const TomlValue& entry) {
  const TomlValue file = entry.get("file");
  const TomlValue folder = entry.get("folder");
  if (static_cast<bool>(file) == static_cast<bool>(folder))
    entry.reject_choice("expected one of file and folder");
  if (file) return {file.file_relative(file.string())};
  std::vector<std::string> out;
  const std::string path = folder.file_relative(folder.string());
  std::error_code code;
  for (const auto& found : std::filesystem::directory_iterator(path, code)) {
    if (found.path().extension() == ".bpms") out.push_back(found.path().string());
  }
  if (out.empty()) folder.reject("no .bpms files in " + in_quotes(path));
  std::ranges::sort(out);
  return out;
}

PlantSet read_plant_files(const std::vector<std::string>& files) {
  PlantSet out;
  out.plants.resize(files.size());
  std::vector<std::exception_ptr> errors(files.size());
  parallel_for(files.size(), [&](std::size_t i) {
    try {
      out.plants[i].file = files[i];
      out.plants[i].plant = std::make_shared<Plant>(read_plant(files[i]));
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  std::set<std::string> known;  // plants may share a library
  for (const CanopyPlant& plant : out.plants) {
    for (const std::string& input : plant.plant->inputs)
      if (known.insert(input).second) out.inputs.push_back(input);
  }
  collect_notes(out);
  return out;
}

}  // namespace bpms
