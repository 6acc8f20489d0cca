// The table that PROSPECT needs: refractive index and specific absorption of the constituents by wavelength.
// White-space or comma separated; the first line names its columns, in any order and case, by the names of
// the published tables or plainer ones: lambda, nrefrac, sac_chl, sac_car, sac_ant, sac_brown, sac_ewt,
// sac_lma, sac_prot, sac_cbc. A table may lack constituents (those of PROSPECT-5 and -D do).
#pragma once
#include <array>
#include <string>
#include <vector>

#include "simulate/materials/prospect_leaf.h"

namespace bpms {

struct ProspectTable {
  std::vector<double> nm, refractive_index;
  std::array<std::vector<double>, leaf_constituents> absorption;  // empty: no such column
};
ProspectTable read_prospect_table(const std::string& path);
ProspectTable parse_prospect_table(const std::string& path, const std::string& text);

// The column's first name, for messages: "sac_chl".
const char* prospect_column(std::size_t constituent);

}  // namespace bpms
