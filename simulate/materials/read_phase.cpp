#include "simulate/materials/read_phase.h"

namespace bpms {

SpectralPhase read_phase(const TomlValue& table, const MaterialContext& context) {
  SpectralPhase out;
  const TomlValue phase = table.get("phase");
  const std::string kind = phase ? phase.one_of({"isotropic", "henyey_greenstein", "legendre"}) : "isotropic";
  const std::vector<double> none(context.bands().count(), 0.0);
  out.asymmetry = out.a1 = out.a2 = none;
  if (kind == "henyey_greenstein") {
    out.function = PhaseFunction::henyey_greenstein;
    out.asymmetry = context.spectrum(table.require("asymmetry"), -0.95, 0.95);
  } else if (kind == "legendre") {
    out.function = PhaseFunction::legendre;
    const TomlValue second = table.get("a2");
    out.a1 = context.spectrum(table.require("a1"), -3.0, 3.0);
    if (second) out.a2 = context.spectrum(second, -3.0, 3.0);
    for (std::size_t band = 0; band < none.size(); ++band) {
      for (int i = -100; i <= 100; ++i)
        if (out.at(band)(i / 100.0) < 0)
          table.require("a1").reject(
              fmt::format("a1 {} and a2 {} make the phase function negative at cos g = {} in {}: expected at "
                          "least 0",
                          out.a1[band], out.a2[band], i / 100.0, context.bands().name(band)));
    }
  }
  return out;
}

}  // namespace bpms
