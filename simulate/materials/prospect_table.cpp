#include "simulate/materials/prospect_table.h"

#include <algorithm>
#include <cctype>

#include "core/text.h"
#include "simulate/materials/spectrum.h"

namespace bpms {
namespace {

// The names of a column; the first is the published one.
using ColumnNames = std::vector<std::string>;
const ColumnNames wavelength_names{"lambda", "wavelength", "wavelength_nm", "wl", "nm"};
const ColumnNames index_names{"nrefrac", "n", "nr", "refractive_index", "refractive"};
const std::array<ColumnNames, leaf_constituents> constituent_names{{
    {"sac_chl", "kab", "k_cab", "cab", "chlorophyll"},
    {"sac_car", "kcar", "k_car", "car", "carotenoids"},
    {"sac_ant", "kant", "k_ant", "ant", "anthocyanins"},
    {"sac_brown", "kbrown", "k_brown", "brown"},
    {"sac_ewt", "kw", "k_cw", "cw", "ewt", "water"},
    {"sac_lma", "km", "k_cm", "cm", "lma", "dry_matter"},
    {"sac_prot", "kprot", "k_prot", "prot", "proteins"},
    {"sac_cbc", "kcbc", "k_cbc", "cbc"},
}};

bool is_one_of(const ColumnNames& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Where the columns of a table go; nothing for those that are not known.
class ProspectColumns {
 public:
  ProspectColumns(TokenReader& header, ProspectTable& table) {
    for (auto token = header.next(); token; token = header.next()) {
      std::string name(token->text);
      for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      std::vector<double>* place = nullptr;
      if (is_one_of(wavelength_names, name)) place = &table.nm;
      if (is_one_of(index_names, name)) place = &table.refractive_index;
      for (std::size_t i = 0; i < leaf_constituents; ++i)
        if (is_one_of(constituent_names[i], name)) place = &table.absorption[i];
      if (place != nullptr && std::find(places.begin(), places.end(), place) != places.end())
        bad_input(header.where(*token), "{} is a second column of its kind", in_quotes(token->text));
      places.push_back(place);
    }
    for (const auto& [place, names] :
         {std::pair{&table.nm, &wavelength_names}, std::pair{&table.refractive_index, &index_names}})
      if (std::find(places.begin(), places.end(), place) == places.end())
        bad_input({header.file(), 1},
                  "no column {}: expected a line of column names such as lambda nrefrac "
                  "sac_chl sac_car sac_ewt sac_lma",
                  names->front());
  }
  std::vector<std::vector<double>*> places;
};

}  // namespace

const char* prospect_column(std::size_t constituent) {
  return constituent_names[constituent].front().c_str();
}

ProspectTable parse_prospect_table(const std::string& path, const std::string& text) {
  ProspectTable out;
  std::vector<std::vector<double>*> places;
  int line_number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = text.substr(at, end - at);
    at = end + 1;
    ++line_number;
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
    TokenReader reader(path, line);
    if (!reader.peek()) continue;
    if (places.empty()) {
      places = ProspectColumns(reader, out).places;
      continue;
    }
    std::size_t column = 0;
    for (auto token = reader.next(); token; token = reader.next(), ++column) {
      const SourceLocation where{path, line_number, token->column};
      if (column == places.size()) bad_input(where, "more values than the {} columns", places.size());
      const auto number = parse_number(token->text);
      if (!number) bad_input(where, "expected a number, found {}", in_quotes(token->text));
      std::vector<double>* place = places[column];
      if (place == nullptr) continue;
      if (place == &out.nm && !place->empty() && *number <= place->back())
        bad_input(where, "wavelength {} nm does not come after {} nm: expected increasing wavelengths",
                  *number, place->back());
      if (place == &out.refractive_index && !(*number >= 1 && *number <= 3))
        bad_input(where, "refractive index {}: expected 1 to 3", *number);
      if (*number < 0) bad_input(where, "found {}: expected at least 0", *number);
      place->push_back(*number);
    }
    if (column < places.size())
      bad_input({path, line_number}, "{} values in {} columns", column, places.size());
  }
  if (out.nm.empty()) bad_input({path}, "no rows of coefficients");
  return out;
}

ProspectTable read_prospect_table(const std::string& path) {
  return parse_prospect_table(path, read_text(path));
}

}  // namespace bpms
